#pragma once
// Values as bytes and back, to the last bit: one list of members serves both ways.
//
// A struct takes part by visit(archive, value) in its own namespace, which names all members by a structured binding, so that a member
// that is added and not named here does not compile:
//
//     template <class Archive>
//     void visit(Archive& archive, Track& track) {
//       auto& [facet, height] = track;
//       archive(facet, height);
//     }

#include <array>
#include <bit>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "base/seldom.hpp"
#include "base/types.hpp"

namespace nereid {

/// What was to be read is cut short, or is no such thing.
struct DamagedArchive : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Appends values to bytes.
class Writer {
 public:
  template <class... Values>
  void operator()(const Values&... values) {
    (add(values), ...);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  template <class Value>
  void add(const Value& value) {
    if constexpr (std::is_arithmetic_v<Value> || std::is_enum_v<Value>)
      append(&value, sizeof value);
    else
      visit(*this, const_cast<Value&>(value));  // which names members and changes none
  }
  template <class Value>
  void add(const std::vector<Value>& values) {
    add(static_cast<std::uint64_t>(values.size()));
    if constexpr (std::is_arithmetic_v<Value> || std::is_enum_v<Value>)
      append(values.data(), values.size() * sizeof(Value));
    else
      for (const Value& value : values) add(value);
  }
  template <class Value, std::size_t count>
  void add(const std::array<Value, count>& values) {
    for (const Value& value : values) add(value);
  }
  template <class... Kinds>
  void add(const std::variant<Kinds...>& any) {
    add(static_cast<std::uint64_t>(any.index()));
    std::visit([this](const auto& one) { add(one); }, any);
  }
  template <class Value>
  void add(const Seldom<Value>& seldom) {
    add(seldom.exists());
    if (seldom.exists()) add(*seldom);
  }
  void add(const std::string& text) {
    add(static_cast<std::uint64_t>(text.size()));
    append(text.data(), text.size());
  }
  template <class Number, int rows, int columns, int options, int most_rows, int most_columns>
  void add(const Eigen::Matrix<Number, rows, columns, options, most_rows, most_columns>& values) {
    if constexpr (rows == Eigen::Dynamic || columns == Eigen::Dynamic)
      add(static_cast<std::int64_t>(values.rows())), add(static_cast<std::int64_t>(values.cols()));
    append(values.data(), static_cast<std::size_t>(values.size()) * sizeof(Number));
  }
  void append(const void* data, std::size_t size) { bytes_.append(static_cast<const char*>(data), size); }

  std::string bytes_;
};

/// Takes values out of bytes in the order in which a Writer was given them. DamagedArchive where they do not suffice.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : rest_(bytes) {}
  template <class... Values>
  void operator()(Values&... values) {
    (take(values), ...);
  }
  bool is_at_end() const { return rest_.empty(); }

 private:
  template <class Value>
  void take(Value& value) {
    if constexpr (std::is_arithmetic_v<Value> || std::is_enum_v<Value>)
      copy(&value, sizeof value);
    else
      visit(*this, value);
  }
  template <class Value>
  void take(std::vector<Value>& values) {
    values.resize(count_of(std::is_arithmetic_v<Value> || std::is_enum_v<Value> ? sizeof(Value) : 1));
    if constexpr (std::is_arithmetic_v<Value> || std::is_enum_v<Value>)
      copy(values.data(), values.size() * sizeof(Value));
    else
      for (Value& value : values) take(value);
  }
  template <class Value, std::size_t count>
  void take(std::array<Value, count>& values) {
    for (Value& value : values) take(value);
  }
  template <class... Kinds>
  void take(std::variant<Kinds...>& any) {
    std::uint64_t kind = 0, place = 0;
    take(kind);
    if (kind >= sizeof...(Kinds)) damaged();
    ((place++ == kind ? static_cast<void>(any.template emplace<Kinds>()) : static_cast<void>(0)), ...);
    std::visit([this](auto& one) { take(one); }, any);
  }
  template <class Value>
  void take(Seldom<Value>& seldom) {
    bool exists = false;
    take(exists);
    seldom = {};
    if (exists) take(seldom.make());
  }
  void take(std::string& text) {
    text.resize(count_of(1));
    copy(text.data(), text.size());
  }
  template <class Number, int rows, int columns, int options, int most_rows, int most_columns>
  void take(Eigen::Matrix<Number, rows, columns, options, most_rows, most_columns>& values) {
    if constexpr (rows == Eigen::Dynamic || columns == Eigen::Dynamic) {
      std::int64_t there = 0, across = 0;
      take(there), take(across);
      const auto most = static_cast<std::int64_t>(rest_.size() / sizeof(Number));
      const bool fit = (rows == Eigen::Dynamic || there == rows) && (columns == Eigen::Dynamic || across == columns);
      if (!fit || there < 0 || across < 0 || (there > 0 && across > most / there)) damaged();
      values.resize(there, across);
    }
    copy(values.data(), static_cast<std::size_t>(values.size()) * sizeof(Number));
  }
  /// How many values follow; damaged where so many of that size [bytes] would not fit.
  std::size_t count_of(std::size_t size) {
    std::uint64_t count = 0;
    take(count);
    if (count > rest_.size() / size) damaged();
    return static_cast<std::size_t>(count);
  }
  void copy(void* to, std::size_t size) {
    if (size > rest_.size()) damaged();
    if (size > 0) std::memcpy(to, rest_.data(), size);
    rest_.remove_prefix(size);
  }
  [[noreturn]] static void damaged() { throw DamagedArchive("it is cut short, or not what it says it is"); }

  std::string_view rest_;
};

}  // namespace nereid

#pragma once
#include <functional>
#include <memory>

namespace nereid {

/// A thread that does one piece of work at a time beside its owner's, as writing a file. Where the system starts none, the
/// owner's does it.
///
/// Needs  work that does not call parallel_for
class Beside {
 public:
  Beside();
  ~Beside();  ///< waits; what the work threw that nobody asked for is lost
  Beside(const Beside&) = delete;
  Beside& operator=(const Beside&) = delete;

  /// Waits as wait() does, then begins the work, and goes on.
  void begin(std::function<void()> work);
  /// Until the work has ended. Throws what it threw, once.
  void wait();
  /// Throws what the work threw, as soon as it has; does not wait.
  void look();
  bool has_thread() const;

 private:
  struct Desk;
  std::unique_ptr<Desk> desk_;
};

}  // namespace nereid

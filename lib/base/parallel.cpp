#include "base/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <memory>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "base/check.hpp"

namespace nereid {

namespace {

/// Waits until `word` is no longer `old`: for a moment busily, as the next loop of a step is near; then
/// asleep, so that a machine with other work to do can do it.
template <class Word>
void wait_while(const std::atomic<Word>& word, Word old) {
  for (int i = 0; i < 4000; ++i) {
    if (word.load(std::memory_order_acquire) != old) return;
#if defined(__x86_64__)
    __builtin_ia32_pause();
#endif
  }
  word.wait(old, std::memory_order_acquire);
}

/// Threads that wait for loops to share.
class Team {
 public:
  explicit Team(int size) : size_(size) {
    workers_.reserve(static_cast<std::size_t>(size));  // so that only the start of a thread can fail
    try {
      for (int t = 1; t < size; ++t) workers_.emplace_back([this, t] { work(t); });
    } catch (const std::system_error& error) {
      stop();
      throw MachineError("cannot start " + std::to_string(size) + " threads: " + error.code().message());
    }
  }

  ~Team() { stop(); }

  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  int size() const { return size_; }

  void run(Index count, void (*range)(void*, Index, Index), void* context) {
    count_ = count, range_ = range, context_ = context;
    busy_.store(size_ - 1, std::memory_order_relaxed);
    call();
    do_share(0);
    for (int left = busy_.load(std::memory_order_acquire); left > 0; left = busy_.load(std::memory_order_acquire))
      wait_while(busy_, left);
  }

 private:
  void stop() {
    range_ = nullptr;
    call();
    for (std::thread& worker : workers_) worker.join();
  }

  void call() {
    calls_.fetch_add(1, std::memory_order_release);
    calls_.notify_all();
  }

  void do_share(int t) const {
    const auto at = [this](int i) { return static_cast<Index>(static_cast<std::int64_t>(count_) * i / size_); };
    range_(context_, at(t), at(t + 1));
  }

  void work(int t) {
    for (std::uint64_t seen = 0;; ++seen) {
      wait_while(calls_, seen);
      if (range_ == nullptr) return;
      do_share(t);
      if (busy_.fetch_sub(1, std::memory_order_acq_rel) == 1) busy_.notify_one();
    }
  }

  int size_;
  Index count_ = 0;
  void (*range_)(void*, Index, Index) = nullptr;
  void* context_ = nullptr;
  std::atomic<std::uint64_t> calls_ = 0;
  std::atomic<int> busy_ = 0;
  std::vector<std::thread> workers_;
};

std::unique_ptr<Team>& the_team() {
  static std::unique_ptr<Team> team;
  return team;
}

Team& team() {
  if (!the_team()) the_team() = std::make_unique<Team>(static_cast<int>(std::max(1U, std::thread::hardware_concurrency())));
  return *the_team();
}

}  // namespace

void use_threads(int count) {
  if (the_team() && the_team()->size() == count) return;
  the_team().reset();
  the_team() = std::make_unique<Team>(std::max(1, count));
}

int threads() { return team().size(); }

void share_loop(Index count, void (*range)(void*, Index, Index), void* context) {
  if (team().size() == 1) return range(context, 0, count);
  team().run(count, range, context);
}

}  // namespace nereid

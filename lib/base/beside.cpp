#include "base/beside.hpp"

#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>

namespace nereid {

struct Beside::Desk {
  std::mutex mutex;
  std::condition_variable changed;
  std::function<void()> work;      // while busy it belongs to the thread
  std::exception_ptr failure = {};
  bool busy = false, ends = false;
  std::atomic<bool> has_failed = false;
  std::thread thread = {};

  void serve() {
    for (std::unique_lock lock(mutex);;) {
      changed.wait(lock, [this] { return busy || ends; });
      if (!busy) return;
      lock.unlock();
      std::exception_ptr thrown;
      try {
        work();
      } catch (...) {
        thrown = std::current_exception();
      }
      work = nullptr;  // with all that it held
      lock.lock();
      failure = thrown, has_failed = thrown != nullptr, busy = false;
      changed.notify_all();
    }
  }
};

Beside::Beside() : desk_(std::make_unique<Desk>()) {
  try {
    desk_->thread = std::thread([desk = desk_.get()] { desk->serve(); });
  } catch (const std::system_error&) {  // the system starts no more: begin() does the work
  }
}

Beside::~Beside() {
  if (!has_thread()) return;
  {
    const std::lock_guard lock(desk_->mutex);
    desk_->ends = true;
  }
  desk_->changed.notify_all();
  desk_->thread.join();
}

void Beside::begin(std::function<void()> work) {
  wait();
  if (!has_thread()) return work();
  {
    const std::lock_guard lock(desk_->mutex);
    desk_->work = std::move(work), desk_->busy = true;
  }
  desk_->changed.notify_all();
}

void Beside::wait() {
  std::unique_lock lock(desk_->mutex);
  desk_->changed.wait(lock, [this] { return !desk_->busy; });
  desk_->has_failed = false;
  if (desk_->failure) std::rethrow_exception(std::exchange(desk_->failure, nullptr));
}

void Beside::look() {
  if (desk_->has_failed) wait();
}

bool Beside::has_thread() const { return desk_->thread.joinable(); }

}  // namespace nereid

#include "base/work_apart.hpp"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>

#include "base/stop_request.hpp"

namespace stillpoint {
namespace {

std::atomic<bool> some_was_left = false;

struct WorkState {
  std::mutex mutex;
  std::condition_variable ended;
  bool done = false;
  std::exception_ptr failure;
};

}  // namespace

void work_apart(const std::function<void()>& work) {
  if (!may_be_stopped()) return work();
  const auto state = std::make_shared<WorkState>();
  std::thread([work, state] {
    std::exception_ptr failure;
    try {
      work();
    } catch (...) {
      failure = std::current_exception();
    }
    const std::lock_guard lock(state->mutex);
    state->failure = failure;
    state->done = true;
    state->ended.notify_one();
  }).detach();
  constexpr std::chrono::milliseconds between_questions(20);
  std::unique_lock lock(state->mutex);
  while (!state->ended.wait_for(lock, between_questions, [&] { return state->done; })) {
    try {
      heed_stop_request();
    } catch (...) {
      some_was_left = true;
      throw;
    }
  }
  if (state->failure) std::rethrow_exception(state->failure);
}

bool work_was_left() { return some_was_left; }

}  // namespace stillpoint

#include "base/stop_request.hpp"

#include <utility>

namespace stillpoint {
namespace {

thread_local const std::function<bool()>* whom_to_ask = nullptr;

}  // namespace

StopScope::StopScope(std::function<bool()> asked) : asked_(std::move(asked)), before_(whom_to_ask) {
  whom_to_ask = asked_ ? &asked_ : nullptr;
}
StopScope::~StopScope() { whom_to_ask = before_; }

bool may_be_stopped() { return whom_to_ask != nullptr; }

void heed_stop_request() {
  if (whom_to_ask && (*whom_to_ask)()) throw Stopped();
}

}  // namespace stillpoint

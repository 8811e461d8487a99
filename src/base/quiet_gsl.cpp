#include "base/quiet_gsl.hpp"

#include <mutex>

#include <gsl/gsl_errno.h>

namespace stillpoint {
namespace {

// The handler is shared by the whole program: restoring a handler that was read earlier could end another's silence.
struct {
  std::mutex mutex;
  long living = 0;
  gsl_error_handler_t* former = nullptr;
} handler;

}  // namespace

QuietGsl::QuietGsl() {
  const std::lock_guard lock(handler.mutex);
  if (handler.living++ == 0) handler.former = gsl_set_error_handler_off();
}

QuietGsl::~QuietGsl() {
  const std::lock_guard lock(handler.mutex);
  if (--handler.living == 0) gsl_set_error_handler(handler.former);
}

}  // namespace stillpoint

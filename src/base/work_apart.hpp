// Calls of library functions that cannot be interrupted, such as the factorisation of a large matrix.
#pragma once

#include <functional>

namespace stillpoint {

/// Does the work in a thread of its own, waits for it, and throws what it throws; does it in this thread if no
/// StopScope is active. If a stop is requested meanwhile, throws Stopped and abandons the work, which must own all that
/// it uses.
void work_apart(const std::function<void()>& work);

/// Whether some work was abandoned: then the process has to end by std::_Exit, which destroys nothing the work still
/// uses.
bool work_was_left();

}  // namespace stillpoint

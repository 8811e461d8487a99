// Calls of a library that cannot be told to stop, such as the factorisation of a large matrix.
#pragma once

#include <functional>

namespace stillpoint {

/// Does the work in a thread of its own, waits for it, and throws what it throws; here if nobody may stop it. If it is
/// to end before it is done, throws Stopped and leaves the work to itself: it must own all that it uses.
void work_apart(const std::function<void()>& work);

/// Whether some work was left to itself: the process then has to end by std::_Exit, which takes nothing away from it.
bool work_was_left();

}  // namespace stillpoint

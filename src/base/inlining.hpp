// How much of what a loop calls is inlined into it.
#pragma once

/// Inlines all that a function calls, so that its loop over points is vectorised. In a build for a sanitizer, which
/// vectorises nothing, the checks of each access make so large a function of it that the compiler needs a quarter of an
/// hour and two gigabytes for the laws in space. The build defines STILLPOINT_SANITIZED there.
#ifdef STILLPOINT_SANITIZED
#define STILLPOINT_FLATTEN
#else
#define STILLPOINT_FLATTEN [[gnu::flatten]]
#endif

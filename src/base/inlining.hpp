// How much of what a loop calls is inlined into it.
#pragma once

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define STILLPOINT_SANITIZED
#endif
#elif defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define STILLPOINT_SANITIZED
#endif

/// Inlines all that a function calls, so that its loop over points is vectorised. In a build for a sanitizer, which
/// vectorises nothing, the checks of each access make so large a function of it that the compiler needs a quarter of an
/// hour and two gigabytes for the laws in space.
#ifdef STILLPOINT_SANITIZED
#define STILLPOINT_FLATTEN
#else
#define STILLPOINT_FLATTEN [[gnu::flatten]]
#endif

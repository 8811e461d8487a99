// How often operator new was called in this program, so that tests can prove that something allocates nothing.
#pragma once

namespace stillpoint::test {

long allocation_count();

}  // namespace stillpoint::test

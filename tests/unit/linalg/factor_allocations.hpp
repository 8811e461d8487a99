// How often the library behind the sparse factors has asked for memory, so that tests can prove that a solve does not.
#pragma once

namespace stillpoint::test {

/// Counts while it lives; one at a time.
class FactorAllocations {
 public:
  FactorAllocations();
  ~FactorAllocations();
  FactorAllocations(const FactorAllocations&) = delete;
  FactorAllocations& operator=(const FactorAllocations&) = delete;
  long count() const;
};

}  // namespace stillpoint::test

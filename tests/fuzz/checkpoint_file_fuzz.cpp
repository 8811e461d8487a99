// What follows the head of a checkpoint gives a state no larger than the file, or an error.
#include "checkpoint.hpp"
#include "fuzz_target.hpp"
#include "output/checkpoint_file.hpp"

using namespace stillpoint;
using namespace stillpoint::fuzz;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    std::size_t numbers = 0;
    for (const auto& [name, value] : read_checkpoint(write_checkpoint_of(text_of(data, size))))
      numbers += std::visit([](const auto& values) { return values.size(); }, value);
    require(numbers <= size + 512, "no byte is read as two values");
  } catch (const StateError&) {
  }
  return 0;
}

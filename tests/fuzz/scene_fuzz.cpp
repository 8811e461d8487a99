// The text of a scene file gives a scene, or problems that say what is wrong and where.
#include <stillpoint/scene.hpp>

#include "fuzz_target.hpp"

using namespace stillpoint;
using namespace stillpoint::fuzz;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    load_scene("scene.toml", text_of(data, size), {});
  } catch (const SceneError& error) {
    require(!error.problems().empty(), "a scene is refused for a problem");
    require_clear(error.problems());
  }
  return 0;
}

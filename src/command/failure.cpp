#include "command/failure.hpp"

#include <stillpoint/scene_error.hpp>
#include <stillpoint/state_archive.hpp>

#include <exception>
#include <new>

#include "command/command_line.hpp"

namespace stillpoint::command {

Failure failure_of_exception() {
  try {
    throw;
  } catch (const SceneError& error) {
    return {bad_input, error.what()};
  } catch (const StateError& error) {
    return {bad_input, error.what()};
  } catch (const std::bad_alloc&) {
    return {failed, "stillpoint: no memory is left"};
  } catch (const std::exception& error) {
    return {failed, std::string("stillpoint: ") + error.what()};
  }
}

}  // namespace stillpoint::command

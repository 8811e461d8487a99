// The table of the stages of a run.
#include "scene/input/scene_keys.hpp"

namespace stillpoint {

[[gnu::no_sanitize_address]] void add_stages(Tables& tables) {
  tables
      .add({"stage", "bodies that are placed or dug away, supports and loads that begin or end, at a time of the run",
            Repeat::array},
           &Scene::stages)
      .key("at", &StageSpec::at, "when it begins; later if the stage before waits for equilibrium",
           {.range = kNotNegative, .unit = "s", .required = true})
      .key("add", &StageSpec::add, "names of bodies that are placed, and of rigid bodies; before, they are not there",
           {.list = true})
      .key("K0", &StageSpec::K0,
           "of the bodies that are placed: they bear the weight that is placed above them, sigma_xx = sigma_zz = K0 "
           "sigma_yy",
           {.variables = "x", .fallback = "they are free of stress"})
      .key("remove", &StageSpec::remove, "names of bodies and rigid bodies that are taken away", {.list = true})
      .key("hold", &StageSpec::hold,
           "names of supports that hold and of loads that act from now on; before, they do not", {.list = true})
      .key("release", &StageSpec::release, "names of supports that hold and of loads that act no longer",
           {.list = true})
      .key("change", &StageSpec::change, "names of bodies that get another material", {.list = true})
      .key("material", &StageSpec::material, "the material of each of them", {.list = true})
      .key("equilibrium", &StageSpec::equilibrium, "the next stage waits until this one is in equilibrium")
      .key("ramp", &StageSpec::ramp,
           "time over which the forces that the stage puts out of balance fade: weight and loads that are added come "
           "on, what "
           "dug material and released supports bore and loads that end go; 0: at once",
           {.range = kNotNegative, .unit = "s", .fallback = "half of the stage; none with a static solver"});
}

}  // namespace stillpoint

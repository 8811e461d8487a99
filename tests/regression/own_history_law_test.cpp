// Bodies of laws with a history of a user's own: UMATs from shared libraries, and C++ types.
#include <stillpoint/drucker_prager.hpp>
#include <stillpoint/own_history_law.hpp>
#include <stillpoint/run.hpp>
#include <stillpoint/simulation.hpp>

#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "compiled_umat.hpp"
#include "files.hpp"
#include "largest.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using test::compiled_umat, test::TemporaryFolder;

namespace {

// A block on a rough floor, so heavy and pushed so hard aside that it flows and turns.
std::string flowing_block(const std::string& state, const std::string& material, int cells = 6) {
  const bool in_space = state == "space";
  const auto vector = [&](const std::string& plane, const std::string& z) {
    return "[" + plane + (in_space ? ", " + z : "") + "]";
  };
  std::string text =
      fmt::format("dim = {}\n[grid]\nmin = {}\nmax = {}\ncells = {}\n", in_space ? 3 : 2, vector("0, 0", "0"),
                  vector("1.5, 1.5", "1.5"), vector(fmt::format("{0}, {0}", cells), fmt::format("{}", cells)));
  text += "[body]\nmaterial = \"m\"\nmax = " + vector("1, 1", "1") + "\n";
  if (!in_space) text += "state = \"" + state + "\"\n";
  text += "[material.m]\n" + material + "\n";
  text += "[body_force]\nvalue = " + vector(state == "axisymmetric" ? "0, -12" : "4, -12", "1") + "\n";
  text += "[[support]]\nface = \"bottom\"\n";
  if (state == "axisymmetric") text += "[[support]]\nface = \"left\"\nkind = \"roller\"\n";
  return text + "[damping]\nc = 3\n[stop]\nresidual = 0\nsteps = 1000000\n[checkpoint]\nevery_steps = 20\n";
}

const char* const built_in = "law = \"drucker-prager\"\nE = 1e4\nnu = 0.3\nrho = 1\nc = 2.5";
std::string umat(const std::string& library, const std::string& more = "") {
  return "law = \"umat\"\nlibrary = \"" + library +
         ".so\"\nprops = [1e4, 0.3, 2.5]\nstatev = [\"plastic_strain\"]\nrho = 1\n" + more;
}

Scene scene_of(const TemporaryFolder& folder, const std::string& text, const std::vector<std::string>& set = {}) {
  return load_scene(folder.write("scene.toml", text), set);
}

struct Fields {
  std::vector<double> u, stress, plastic_strain;
};

Fields after(int steps, const Scene& scene, int threads = 1) {
  Simulation simulation(scene, {.threads = threads, .stops = false});
  for (int k = 0; k < steps; ++k) simulation.step();
  const auto field = [&](const char* name) {
    const ConstVec values = simulation.field(name);
    return std::vector<double>(values.begin(), values.end());
  };
  return {field("u"), field("stress"), field("plastic_strain")};
}

void check_same(const Fields& a, const Fields& b, double share) {
  for (const auto part : {&Fields::u, &Fields::stress, &Fields::plastic_strain}) {
    REQUIRE(largest_magnitude(b.*part) > 0);
    CHECK(largest_difference(a.*part, b.*part) <= share * largest_magnitude(b.*part));
  }
}

template <StressState S>
struct MyCone : DruckerPrager<S> {
  explicit MyCone(const LawParameters& of) : DruckerPrager<S>({.E = of.at("E"), .nu = of.at("nu"), .c = of.at("c")}) {}
};

void add_my_cone() {
  using enum StressState;
  add_law<MyCone, plane_strain, axisymmetric, space>(
      {.name = "my-cone", .parameters = {{.name = "E"}, {.name = "nu"}, {.name = "c"}}});
}

std::string refusal(const TemporaryFolder& folder, const std::string& text, const std::vector<std::string>& set = {}) {
  const Scene* loaded = nullptr;
  Scene scene;
  try {
    scene = scene_of(folder, text, set);
    loaded = &scene;
    Simulation simulation(scene, {.threads = 1});
  } catch (const SceneError& error) {
    return loaded ? loaded->located(error).what() : error.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("a block of a UMAT in Fortran or C moves and flows as one of the built-in law, in one phase and in many") {
  const TemporaryFolder folder;
  compiled_umat(folder, "von_mises.f", "fortran");
  compiled_umat(folder, "von_mises.c", "c");
  for (const char* state : {"plane-strain", "axisymmetric", "space"}) {
    for (const char* motion : {"phase.max_motion=none", "phase.max_motion=0.01"}) {
      for (const char* library : {"fortran", "c"}) {
        CAPTURE(state, motion, library);
        const int steps = 120;
        const Fields own = after(steps, scene_of(folder, flowing_block(state, umat(library)), {motion}));
        check_same(own, after(steps, scene_of(folder, flowing_block(state, built_in), {motion})), 1e-10);
        CHECK(largest_value(own.plastic_strain) > 1e-4);
      }
    }
  }
}

TEST_CASE("a UMAT of Cam clay is pressed and sheared as ground of the built-in law, in one phase and in many") {
  const TemporaryFolder folder;
  compiled_umat(folder, "cam_clay.f", "clay");
  const std::string ours =
      "law = \"cam-clay\"\nM = 1.2\nlambda = 0.2\nkappa = 0.04\nnu = 0.3\nrho = 1\ne0 = 1\nOCR = 1.2";
  const std::string theirs =
      "law = \"umat\"\nlibrary = \"clay.so\"\nprops = [1.2, 0.2, 0.04, 0.3, 1, 1.2]\n"
      "statev = [\"pc\", \"void_ratio\", \"plastic_strain\"]\nrho = 1";
  for (const std::string state : {"plane-strain", "axisymmetric", "space"}) {
    const bool in_space = state == "space";
    const std::string third = in_space ? ", 1" : "";
    const auto scene = [&](const std::string& material, const std::string& motion) {
      std::string text = fmt::format("dim = {}\n[grid]\nmin = [0, 0{}]\nmax = [1, 1{}]\ncells = [4, 4{}]\n",
                                     in_space ? 3 : 2, in_space ? ", 0" : "", third, in_space ? ", 4" : "");
      text += "[body]\nmaterial = \"m\"\n";
      if (!in_space) text += "state = \"" + state + "\"\n";
      text += "[material.m]\n" + material + "\n[initial]\nstress = [-100, -100, -100, 0";
      text += in_space ? ", 0, 0]\n" : "]\n";
      text += "[[support]]\nface = \"bottom\"\n[[support]]\nface = \"left\"\nkind = \"roller\"\n";
      text += "[[support]]\nface = \"right\"\nkind = \"roller\"\n";
      text +=
          "[[traction]]\nface = \"top\"\nvalue = [\"0\", \"-100-400*t\"" + std::string(in_space ? ", \"40*t\"]" : "]");
      // The same step for both: that of a UMAT comes from its DDSDDE, here of differences.
      text += "\n[integrator]\nstep = 5e-4\n[damping]\nc = 3\n[stop]\nresidual = 0\nsteps = 1000000\n";
      return scene_of(folder, text, {motion});
    };
    for (const char* motion : {"phase.max_motion=none", "phase.max_motion=0.002"}) {
      CAPTURE(state, motion);
      constexpr int steps = 300;
      const Fields own = after(steps, scene(theirs, motion));
      check_same(own, after(steps, scene(ours, motion)), 1e-10);
      CHECK(largest_value(own.plastic_strain) > 1e-4);
    }
  }
}

TEST_CASE("a law with a history that a program adds moves points as the built-in one of the same formula does") {
  add_my_cone();
  const TemporaryFolder folder;
  for (const char* state : {"plane-strain", "axisymmetric", "space"}) {
    CAPTURE(state);
    const Fields own =
        after(60, scene_of(folder, flowing_block(state, "law = \"my-cone\"\nE = 1e4\nnu = 0.3\nrho = 1\nc = 2.5")));
    check_same(own, after(60, scene_of(folder, flowing_block(state, built_in))),
               1e-12);  // rounding of other instructions
  }
}

TEST_CASE("a UMAT has the same bits with one and with two threads, whether or not it keeps state") {
  const TemporaryFolder folder;
  compiled_umat(folder, "von_mises.f", "fortran");
  compiled_umat(folder, "von_mises.c", "counts", "-DCOUNTS");
  for (const char* library : {"fortran", "counts"}) {
    const Scene scene =
        scene_of(folder, flowing_block("plane-strain", umat(library), 96), {"body_force.value=[4e4, -12e4]"});
    check_same(after(12, scene, 2), after(12, scene, 1), 0);
  }
}

TEST_CASE("a run of a UMAT that is broken off and resumed has the bits of the unbroken one, in phases") {
  const TemporaryFolder folder, whole, broken;
  compiled_umat(folder, "von_mises.f", "fortran");
  const Scene scene = scene_of(folder, flowing_block("plane-strain", umat("fortran")),
                               {"phase.max_motion=0.01", "stop.steps=90", "output.every=0.001"});
  run(scene, {.out = whole.path()});
  {
    Simulation simulation(scene, {.out = broken.path()});
    while (simulation.steps() < 70) simulation.step();
  }
  const auto checkpoint = broken.path() / "checkpoint.h5";
  run(load_scene_of(checkpoint), {.out = broken.path(), .resume = checkpoint});
  CHECK(test::contents(broken.path() / "history.csv") == test::contents(whole.path() / "history.csv"));
  CHECK(test::lines(whole.path() / "history.csv").size() > 5);
}

TEST_CASE("Newton's method finds with a UMAT what it finds with the built-in law, in as many iterations") {
  add_my_cone();
  const TemporaryFolder folder;
  compiled_umat(folder, "von_mises.f", "fortran");
  const auto solved = [&](const std::string& material) {
    Simulation simulation(
        scene_of(folder, flowing_block("plane-strain", material),
                 {"solve.method=newton", "solve.load_steps=4", "stop.residual=1e-11", "body_force.value=[2, -3]"}),
        {.threads = 1});
    CHECK(simulation.run() == RunStatus::equilibrium);
    const ConstVec u = simulation.field("u");
    CHECK(largest_value(simulation.field("plastic_strain")) > 1e-5);
    return std::pair(std::vector<double>(u.begin(), u.end()), simulation.evaluations());
  };
  const auto [u, evaluations] = solved(built_in);
  const auto [of_umat, of_umat_evaluations] = solved(umat("fortran"));
  CHECK(largest_difference(of_umat, u) < 1e-8 * largest_magnitude(u));  // to the residual
  CHECK(of_umat_evaluations <= evaluations + 2);
}

TEST_CASE("where no static solver finds a way since a UMAT gives no answer, the material and the place are told") {
  const TemporaryFolder folder;
  compiled_umat(folder, "faulty.c", "leaves", "-DSHORTENS -Wl,--unresolved-symbols=ignore-all");
  const std::string material = "law = \"umat\"\nlibrary = \"leaves.so\"\nrho = 1";
  for (const char* method : {"newton", "lbfgs", "cg"}) {
    CAPTURE(method);
    Simulation simulation(
        scene_of(folder, flowing_block("plane-strain", material),
                 {std::string("solve.method=") + method, "solve.load_steps=1", "body_force.value=[2e3, -3e3]"}),
        {.threads = 1});
    CHECK(simulation.run() != RunStatus::equilibrium);
    CHECK(simulation.reason().find("of the law is not finite") != std::string::npos);
    CHECK(simulation.reason().find("material.m") != std::string::npos);
  }
}

TEST_CASE("a UMAT stands for the effective stress of undrained ground") {
  const TemporaryFolder folder;
  compiled_umat(folder, "von_mises.c", "c");
  const std::string water = "\nundrained = true\nwater_modulus = 1e5\nporosity = 0.5\n";
  const Fields own = after(60, scene_of(folder, flowing_block("plane-strain", umat("c", water))));
  check_same(own, after(60, scene_of(folder, flowing_block("plane-strain", built_in + water))), 1e-10);
  CHECK(refusal(folder, flowing_block("plane-strain", umat("c", "undrained = true"))).find("needs a water_modulus") !=
        std::string::npos);
}

TEST_CASE("a static solver halves its increments for a UMAT that asks for smaller ones") {
  const TemporaryFolder folder;
  compiled_umat(folder, "faulty.c", "shortens", "-DSHORTENS");
  std::string text = flowing_block("plane-strain", "law = \"umat\"\nlibrary = \"shortens.so\"\nrho = 1");
  Simulation simulation(
      scene_of(folder, text, {"solve.method=newton", "stop.residual=1e-9", "body_force.value=[0, -10]"}),
      {.threads = 1});
  CHECK(simulation.run() == RunStatus::equilibrium);
  CHECK(simulation.evaluations() > 12);  // 1e-3 of strain by at most 2e-4 a time
}

TEST_CASE("what is wrong with a UMAT is told at its key, before anything moves") {
  const TemporaryFolder folder;
  const auto faulty = [&](const std::string& fault, const std::vector<std::string>& set = {}) {
    compiled_umat(folder, "faulty.c", fault, "-D" + fault + " -Wl,--unresolved-symbols=ignore-all");
    return refusal(
        folder, flowing_block("plane-strain", "law = \"umat\"\nlibrary = \"" + fault + ".so\"\nprops = [1]\nrho = 1"),
        set);
  };
  const auto says = [](const std::string& text, const std::string& what) {
    INFO(text);
    CHECK(text.find(what) != std::string::npos);
  };
  const std::string line = "scene.toml:12:11: ", key = line + "material.m.library: ";
  says(refusal(folder, flowing_block("plane-strain", umat("nothing"))), key + "there is no file");
  folder.write("text.so", "no library");
  says(refusal(folder, flowing_block("plane-strain", umat("text"))),
       key + "'" + (folder.path() / "text.so").string() + "' cannot");
  compiled_umat(folder, "faulty.c", "nobody", "-DCALLS_NOBODY");
  says(refusal(folder, flowing_block("plane-strain", umat("nobody"))), "undefined symbol: is_nowhere_");
  compiled_umat(folder, "faulty.c", "other", "-DNAME=other_");
  says(refusal(folder, flowing_block("plane-strain", umat("other"))), key);
  says(faulty("NO_NUMBER"), line + "the UMAT returns STRESS = [nan");
  says(faulty("UNSTABLE"), line + "the UMAT returns a DDSDDE that is not positive definite");
  says(faulty("TIRES"), line + "the UMAT answers a call that is repeated with another");
  says(faulty("LEAVES_AT_ONCE"), line + "the UMAT calls XIT in its first call");
  says(faulty("VISCOUS", {"solve.method=newton"}), "'newton' has no time, and the law 'umat' of material.m answers");
  CHECK(faulty("COUNTS") == "accepted");
  says(refusal(folder, flowing_block("plane-strain", umat("other", "statev = [\"a\", \"a\"]"))), "statev");
  const auto with_names = [&](const std::string& names) {
    compiled_umat(folder, "von_mises.c", "c");
    return refusal(folder, flowing_block("plane-strain", "law = \"umat\"\nlibrary = \"c.so\"\nstatev = " + names +
                                                             "\nprops = [1e4, 0.3, 1]\nrho = 1"));
  };
  says(with_names("[\"a\", \"a\"]"), "scene.toml:13:16: material.m.statev[1]: there are two state variables 'a'");
  says(with_names("[\"stress\"]"), "there is a field 'stress' already");
  says(with_names("[\"1st\"]"), "cannot be the name of a field");
  CHECK(with_names("[\"\", \"\", \"a\"]") == "accepted");
}

TEST_CASE("level ground of a UMAT that cannot do without pressure rests under its initial stress") {
  const TemporaryFolder folder;
  compiled_umat(folder, "faulty.c", "soil", "-DNEEDS_PRESSURE -Wl,--unresolved-symbols=ignore-all");
  std::string text = flowing_block("plane-strain", "law = \"umat\"\nlibrary = \"soil.so\"\nrho = 1");
  text += "[[support]]\nface = \"left\"\nkind = \"roller\"\n[[support]]\nface = \"right\"\nkind = \"roller\"\n";
  const std::vector<std::string> level = {"solve.method=newton", "stop.residual=1e-9", "body_force.value=[0, -10]",
                                          "grid.max=[1, 1.5]", "grid.cells=[4, 6]"};
  CHECK(refusal(folder, text, level).find("calls XIT in its first call") != std::string::npos);
  text += "[initial.geostatic]\nK0 = 0.5\nsurface = 1\n";
  Simulation simulation(scene_of(folder, text, level), {.threads = 1});
  CHECK(simulation.run() == RunStatus::equilibrium);
  CHECK(largest_magnitude(simulation.field("u")) < 1e-12);  // rounding
  CHECK(smallest_value(simulation.field("stress")) == Approx(-10 * (1 - 0.0625)));
}

TEST_CASE("a run tells that a UMAT keeps state, and ends where it calls XIT") {
  const TemporaryFolder folder;
  const std::string options = " -Wl,--unresolved-symbols=ignore-all";
  compiled_umat(folder, "faulty.c", "counts", "-DCOUNTS" + options);
  compiled_umat(folder, "faulty.c", "leaves", "-DLEAVES" + options);
  const auto text = [](const std::string& library) {
    return flowing_block("plane-strain", "law = \"umat\"\nlibrary = \"" + library + ".so\"\nrho = 1");
  };
  const Summary counted = run(scene_of(folder, text("counts"), {"stop.steps=5"}), {});
  REQUIRE_FALSE(counted.notes.empty());
  std::string notes;
  for (const std::string& note : counted.notes) notes += note + "\n";
  CHECK(notes.find("its calls take turns") != std::string::npos);
  CHECK_THROWS_WITH(run(scene_of(folder, text("leaves"), {"body_force.value=[4000, 0]"}), {}),
                    Catch::Contains("it called XIT"));
}

#include <stillpoint/simulation.hpp>

#include <utility>

#include "base/thread_team.hpp"
#include "plan/problem_size.hpp"
#include "scene/throw_scene_error.hpp"
#include "simulation/parts.hpp"
#include "simulation/simulation_impl.hpp"

namespace stillpoint {
Simulation::Simulation(Scene scene, SimulationOptions options) {
  const int all = loop_threads();
  const ThreadScope threads(threads_to_begin_with(options.threads, body_size(scene).points));
  impl_ = located(scene, [&] { return std::make_unique<Impl>(scene, std::move(options), all); });
}
Simulation::Simulation(Problem problem, SimulationOptions options)
    : Simulation(Scene(resolve(std::move(problem))), std::move(options)) {}
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;
Simulation::~Simulation() = default;

RunStatus Simulation::step(double t_stop) {
  const ThreadScope threads(impl_->thread_choice_.threads());
  return impl_->step(t_stop);
}

RunStatus Simulation::run_until(double t) {
  while (!done() && impl_->run_->t < t) step(t);
  return impl_->verdict_.status;
}

bool Simulation::done() const { return impl_->done(); }
RunStatus Simulation::status() const { return impl_->verdict_.status; }
const std::string& Simulation::reason() const { return impl_->verdict_.reason; }
double Simulation::t() const { return impl_->run_->t; }
ConstVec Simulation::u() const { return impl_->run_->motion->u(); }
ConstVec Simulation::v() const { return impl_->run_->motion->v(); }
std::shared_ptr<const Vector> Simulation::state() const { return impl_->run_->motion->shared_y; }
long Simulation::steps() const { return impl_->run_->steps(); }
long Simulation::evaluations() const { return impl_->run_->evaluations(); }
int Simulation::phases() const { return impl_->run_->phases; }
std::size_t Simulation::points() const { return impl_->run_->model.phase->points(); }
double Simulation::residual() {
  const ThreadScope threads(impl_->thread_choice_.threads());
  return impl_->run_->measured.residual();
}
ConstVec Simulation::field(std::string_view name) { return impl_->field(name); }
void Simulation::save(const std::filesystem::path& checkpoint) { impl_->save(checkpoint); }
Summary Simulation::summary() {
  const ThreadScope threads(impl_->thread_choice_.threads());
  return impl_->summary();
}
RelaxationSystem& Simulation::system() { return impl_->run_->motion->system; }
const Stepper& Simulation::stepper() const { return *impl_->run_->motion->stepper; }
SimulationParts Simulation::parts() const {
  return {*impl_->run_->model.phase, impl_->run_->model, impl_->run_->scene, impl_->is_readable_};
}
std::optional<double> Simulation::distance() {
  const ThreadScope threads(impl_->thread_choice_.threads());
  impl_->run_->measured.all();
  return impl_->run_->measured.distance();
}
bool Simulation::loads_settled() const { return impl_->run_->loads_settled(); }

}  // namespace stillpoint

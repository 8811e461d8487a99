// Contacts of hardly a cell. A border feels contact at two places in a cell and direction. Where about as many bear all
// of a force amid a border, as beneath an edge or a roll, the way to rest decides which of them do: states of rest
// differ by a fifth, whatever their residual, and so do states on cells of another size.
#include <fmt/format.h>

#include "base/text.hpp"
#include "simulation/watcher.hpp"

namespace stillpoint {
namespace {

class CoarseContact : public Watcher {
 public:
  void fill_state(Summary& summary, RunState& run) override {
    for (const ContactReport& contact : run.model.phase->supports().contacts(run.t, run.motion->u()))
      if (contact.few > 0)
        add_note(summary, fmt::format("the force on {} is borne by {:.0f} of the places at which a border feels "
                                      "contact, two in a cell and direction: where the contact ends is known to half a "
                                      "cell, and the force may be off by a tenth or more; expected smaller cells there",
                                      in_quotes(contact.name), contact.few));
  }
};

}  // namespace

std::unique_ptr<Watcher> watch_coarse_contact() { return std::make_unique<CoarseContact>(); }

}  // namespace stillpoint

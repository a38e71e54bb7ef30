#include "engine/component.hpp"

#include <stdexcept>

namespace rois {

// Only a component whose description has `confirms_binding` is asked.
void Component::bind(Ticket, Binding const&, Instant) { throw std::logic_error("the component does not implement bind"); }

void Component::parameters_changed(ParameterList const&, Instant) {}

}  // namespace rois

// Base of the components that recognize persons: reports each person once while they are tracked.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "basic/base/robot_component.hpp"

namespace rois::basic {

class PersonRecognition : public ContinuousFunction {
public:
    // `codebook`: of the names that name_of() returns. Both texts must be literals.
    PersonRecognition(Context context, std::string_view event_type, std::string_view codebook)
        : ContinuousFunction{std::move(context)}, event_type_{event_type}, codebook_{codebook} {}

protected:
    // Returns the name to report for a person; nothing if the component cannot report them.
    virtual std::optional<std::string> name_of(RecognizedPerson const&) const = 0;
    // Adds the results of the component's own kind.
    virtual void describe(std::vector<RecognizedPerson> const&, ParameterList&) const {}

private:
    void begin() final { reported_.clear(); }
    void sense(Instant when) final;

    std::string_view event_type_;
    std::string_view codebook_;
    std::set<std::string> reported_;  // temporary names
};

}  // namespace rois::basic

// Where engine and reference differ, and the shortest way there.
#pragma once

#include <optional>
#include <string>

#include "model/reference.hpp"
#include "model/step.hpp"

namespace rois::model {

struct Difference {
    Steps steps;  // the last of them shows it
    std::string expected, found;

    std::string in_words() const;
};

// Plays the steps to both.
std::optional<Difference> difference(Steps const& steps, Flaw flaw = Flaw::none);

// Without the steps and commands that are not needed for a difference.
Difference shrunk(Difference, Flaw flaw = Flaw::none);

}  // namespace rois::model

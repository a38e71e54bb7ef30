// Finds differences between engine and reference, and the shortest history that shows one.
#pragma once

#include <optional>
#include <string>

#include "model/reference.hpp"
#include "model/step.hpp"

namespace rois::model {

struct Difference {
    Steps steps;  // the last one shows the difference
    std::string expected, found;

    std::string in_words() const;
};

// Plays the steps to both. Returns the first difference, or nullopt.
std::optional<Difference> difference(Steps const& steps, Flaw flaw = Flaw::none);

// Removes the steps and commands that the difference does not need.
Difference shrunk(Difference, Flaw flaw = Flaw::none);

}  // namespace rois::model

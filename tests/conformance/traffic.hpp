// What holds for all that a gateway says, whatever is played: each document is looked at here, and the first objection to each of
// these rules is kept.
#pragma once

#include <string>
#include <vector>

#include "kit/vocabulary.hpp"
#include "xml/validation/schemas.hpp"
#include "xml/validation/validator.hpp"

namespace rois::conformance {

// A rule of this kind.
struct StandingRule {
    std::string name;
    std::string proves;
    unsigned seen = 0;        // occasions to see it
    std::string objection{};  // empty: it holds
};

class Traffic {
public:
    Traffic();

    // One occasion to see the rule of this name; `otherwise` is kept when it does not hold.
    void see(std::string const& name, bool holds, std::string const& otherwise);
    // The positions in `results`, as texts and as elements: they say the same.
    void look_at_located(pugi::xml_node results);
    // A document of the messages' or the profiles' schemas.
    void validate(std::string const& document);

    std::vector<StandingRule> const& rules() const { return rules_; }

private:
    std::vector<StandingRule> rules_;
    xml::Validator validator_;
};

}  // namespace rois::conformance

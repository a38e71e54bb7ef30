// The rules for all messages. Each document of a gateway is checked here, in every check. The first violation of each rule is
// kept.
#pragma once

#include <string>
#include <vector>

#include "kit/vocabulary.hpp"
#include "xml/validation/schemas.hpp"
#include "xml/validation/validator.hpp"

namespace rois::conformance {

// A rule for all messages.
struct MessageRule {
    std::string name;
    std::string proves;
    unsigned occasions = 0;   // number of messages to which the rule applied
    std::string violation{};  // the first violation; empty if the rule holds
};

class Traffic {
public:
    Traffic();

    // Counts a message to which the rule `name` applies. If the rule does not hold, keeps `message`.
    void check(std::string const& name, bool holds, std::string const& message);
    // Checks that each position in `results` equals an element `located`.
    void check_located(pugi::xml_node results);
    // Validates a document against the schemas.
    void validate(std::string const& document);

    std::vector<MessageRule> const& rules() const { return rules_; }

private:
    std::vector<MessageRule> rules_;
    xml::Validator validator_;
};

}  // namespace rois::conformance

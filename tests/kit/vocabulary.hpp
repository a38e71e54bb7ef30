// Reads documents of a gateway and writes documents of applications, with known prefixes (names.hpp).
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <vector>

#include "kit/xml.hpp"

namespace rois::kit {

using Values = std::map<std::string, std::vector<std::string>>;  // of results or parameters, by name

// An answer, a notification or a fault, with known prefixes (names.hpp).
class Document {
public:
    explicit Document(std::string const& text);

    std::string name() const { return root().name(); }
    std::string attribute(char const* name) const { return root().attribute(name).value(); }
    std::string text(char const* child) const { return root().child(child).text().get(); }
    std::string ref(char const* child = "component_ref") const { return root().child(child).attribute("rois:code").value(); }
    std::vector<std::string> children() const;  // the names of the child elements, in order
    Values values(char const* list = "results") const;
    std::string whole() const;
    std::string const& as_received() const { return *text_; }

    std::string return_code() const { return attribute("return_code"); }
    std::string reason() const { return text("reason"); }
    std::string fault() const { return name() == "fault" ? attribute("code") : ""; }

    pugi::xml_node root() const { return document_->document_element(); }

private:
    std::shared_ptr<std::string const> text_;
    std::shared_ptr<pugi::xml_document> document_;
};

// --- Conditions ---

Xml equal(std::string const& reference, std::string const& literal);
Xml literal_first(std::string const& literal, std::string const& reference);
Xml both(Xml const& one, Xml const& other);
Xml either(Xml const& one, Xml const& other);
Xml like(std::string const& reference, std::string const& pattern);  // wildcards "*" and "?", escaped by "!"
Xml compared(std::string const& comparison, std::string const& reference, std::string const& literal);  // PropertyIs...
Xml between(std::string const& reference, std::string const& lower, std::string const& upper);
Xml is_null(std::string const& reference);
Xml negation(Xml const& filter);
Xml related(std::string const& relation, std::string const& reference, Xml const& other);  // Within, During, ...
Xml box(std::string const& lower, std::string const& upper, std::string const& frame = "");
Xml place(std::string const& name);
Xml distance(std::string const& length, std::string const& unit = "mm");
Xml undefined_function(std::string const& reference);  // an unknown predicate: is_free(reference)
Xml nearest(std::string const& place);                 // `<fes:SortBy>`, by the component's distance to the place
Xml sorted_by(std::string const& reference, std::string const& order);
Xml ordered(Xml const& filter, Xml const& sort_by);  // `<condition>`; the filter may be empty
Xml where(Xml const& filter);                        // `<condition>`

// `<condition>` for the component type, in the wrapper of the published examples.
Xml of_type(std::string const& type);

// --- Parameters and commands ---

struct Argument {
    std::string name;
    std::string type;
    std::vector<std::string> values;
};

Argument speech_text(std::string const& text);
Argument target_position(std::vector<std::string> const& positions);
Argument time_limit(std::string const& milliseconds);
Xml parameters(std::vector<Argument> const&);  // for set_parameter

struct Command {
    std::string component;
    std::string type = "start";
    std::string id{};
    std::vector<Argument> arguments{};
    std::optional<int> delay{};  // ms
};

Xml unit(Command const&);                                      // of a sequence
Xml pause(int delay);                                          // a unit that only delays
Xml branch(std::vector<Command> const&);                       // commands one after the other
Xml command_list(Command const&);                              // a branch of the flat form
Xml concurrent(Xml const& branches);                           // the parallel unit of the published schema
Xml sequential_unit(Xml const& units);                         // the sequential unit of the specification of 2011
Xml parallel_unit(Xml const& units);                           // the parallel unit of the specification of 2011
Xml sequence(Xml const& units);                                // for execute
std::vector<std::string> command_ids(Document const& answer);  // of an answer of execute, in document order

}  // namespace rois::kit

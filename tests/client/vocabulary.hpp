// What a gateway says, read; and what applications say, written: both in the names of wire.md.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <vector>

namespace rois::client {

using Values = std::map<std::string, std::vector<std::string>>;  // of results or parameters, by name

// An answer, a notification or a fault, in the names of wire.md whatever prefixes it has.
class Document {
public:
    explicit Document(std::string const& text);

    std::string name() const { return root().name(); }
    std::string attribute(char const* name) const { return root().attribute(name).value(); }
    std::string text(char const* child) const { return root().child(child).text().get(); }
    std::string ref(char const* child = "component_ref") const { return root().child(child).attribute("rois:code").value(); }
    std::vector<std::string> children() const;  // their names, in order
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

std::string equal(std::string const& reference, std::string const& literal);
std::string literal_first(std::string const& literal, std::string const& reference);
std::string both(std::string const& one, std::string const& other);
std::string either(std::string const& one, std::string const& other);
std::string like(std::string const& reference, std::string const& pattern);  // "*" and "?"; "!" before them as they are
std::string compared(std::string const& comparison, std::string const& reference, std::string const& literal);  // PropertyIs...
std::string is_null(std::string const& reference);
std::string contrary(std::string const& filter);
std::string related(std::string const& relation, std::string const& reference, std::string const& other);  // Within, During, ...
std::string box(std::string const& lower, std::string const& upper, std::string const& frame = "");
std::string place(std::string const& name);
std::string distance(std::string const& millimetres);
std::string touching(std::string const& reference);  // nothing that a gateway understands
std::string nearest(std::string const& place);       // `<fes:SortBy>`, by the component's distance to it
std::string sorted_by(std::string const& reference, std::string const& order);
std::string ordered(std::string const& filter, std::string const& sort_by);  // `<condition>`; the filter may be empty
std::string where(std::string const& filter);                                // `<condition>`

// --- Parameters and commands ---

struct Argument {
    std::string name;
    std::string type;
    std::vector<std::string> values;  // as XML has them: what was read from a document must be escaped
};

std::vector<std::string> escaped(std::vector<std::string> texts);
Argument speech_text(std::string const& text);
Argument target_position(std::vector<std::string> const& positions);
Argument time_limit(std::string const& milliseconds);
std::string parameters(std::vector<Argument> const&);  // what set_parameter takes

struct Command {
    std::string component;
    std::string type = "start";
    std::string id{};
    std::vector<Argument> arguments{};
    std::optional<int> delay{};  // ms
};

std::string unit(Command const&);                              // of a sequence
std::string pause(int delay);                                  // a unit that only delays
std::string branch(std::vector<Command> const&);               // one after the other
std::string command_list(Command const&);                      // a branch of the flat form
std::string concurrent(std::string const& branches);           // the published parallel unit, of branches in either form
std::string one_after_another(std::string const& units);       // the seed's sequential unit
std::string side_by_side(std::string const& units);            // the seed's parallel unit
std::string sequence(std::string const& units);                // what execute takes
std::vector<std::string> command_ids(Document const& answer);  // of an answer of execute, in document order

}  // namespace rois::client

// Writes the results of the program on standard output, in one of three forms.
#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>

#include "command/output/json.hpp"
#include "rois/connection.hpp"
#include "types/messages.hpp"

namespace rois::command {

// human: aligned, coloured on a terminal. xml: the documents, one after the other. json: one object per line.
enum class Form : std::uint8_t { human, xml, json };

// Thread-safe. Each function writes whole lines at once. Throws Trouble if standard output cannot be written.
class Printer {
public:
    Printer(Form form, bool coloured) : form_{form}, coloured_{coloured} {}

    Form form() const { return form_; }
    bool coloured() const { return coloured_; }

    // Writes a reply. For people, throws Trouble if it is not OK.
    void reply(Reply const&, std::string_view operation);
    void fault(Fault const&, std::string_view operation);
    void notification(Notification const&, std::uint64_t sequence);

    // Changes of the link and missed notifications. In XML, an element of this program.
    void state(StateChange const&);
    void gap(Gap const&);

    // The profile of a component.
    void profile(ComponentEntry const&);

    // Writes a line for people, or the object. In XML, an element of this name with the object's values as attributes.
    void line(std::string_view human, std::string_view element, Json const& object);

    // Writes the text unchanged.
    void text(std::string_view);

private:
    void write(std::string const&);

    Form form_;
    bool coloured_;
    std::mutex mutex_;
};

}  // namespace rois::command

// What the program writes on standard output, in one of three forms; troubles go to standard error.
#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>

#include "command/json.hpp"
#include "rois/connection.hpp"
#include "types/messages.hpp"

namespace rois::command {

// human: aligned, coloured on a terminal. xml: the documents, one after the other. json: an object a line.
enum class Form : std::uint8_t { human, xml, json };

// Each function writes whole lines at once; they may be called from any thread.
class Printer {
public:
    Printer(Form form, bool coloured) : form_{form}, coloured_{coloured} {}

    Form form() const { return form_; }
    bool coloured() const { return coloured_; }

    // The reply of an operation. One that is not OK goes to standard error for people, and is a document like others otherwise.
    void reply(Reply const&, std::string_view operation);
    void fault(Fault const&, std::string_view operation);
    void notification(Notification const&, std::uint64_t sequence);

    // How the link is, what was missed. In XML, a comment.
    void state(StateChange const&);
    void gap(Gap const&);

    // All that a component's profile says, for people; its document otherwise.
    void profile(ComponentEntry const&);

    // A line for people, or its object. In XML, an element of this name with the object's values as attributes.
    void line(std::string_view human, std::string_view element, Json const& object);

    // As it is.
    void text(std::string_view);

private:
    void write(std::string const&);

    Form form_;
    bool coloured_;
    std::mutex mutex_;
};

}  // namespace rois::command

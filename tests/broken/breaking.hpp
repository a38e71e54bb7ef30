// Ways to break a rule.
#pragma once

#include <functional>
#include <pugixml.hpp>
#include <string>
#include <string_view>

#include "broken/proxy.hpp"

namespace rois::broken {

using Edit = std::function<void(pugi::xml_node root)>;

bool is(std::string const& document, std::string const& name);  // its root is <name>
void replace_all(std::string& text, std::string_view part, std::string_view by);
std::string edited(std::string const& document, Edit const&);
// A response to this request.
std::string response(std::string const& request, std::string const& return_code, std::string const& children = "");

// `operation` is answered with `return_code` where it should be answered with `due`, a return code or the code of a fault.
Breaking says(std::string const& operation, std::string const& due, std::string const& return_code,
              std::string const& children = "");
// `operation` is answered with OK and not done.
Breaking does_nothing_at(std::string const& operation);
Breaking edits_answers(std::string const& operation, Edit const&);  // every answer when the operation is empty
Breaking edits_requests(std::string const& operation, Edit const&);
Breaking edits_notifications(std::string const& name, Edit const&);
// `name` comes twice.
Breaking repeats(std::string const& name);
void remove_condition(pugi::xml_node root);
// Every element below, in document order.
void for_each_below(pugi::xml_node root, Edit const&);

}  // namespace rois::broken

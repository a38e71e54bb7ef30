// Functions that break a rule of a gateway. Each returns the changes that the proxy makes.
#pragma once

#include <functional>
#include <pugixml.hpp>
#include <string>
#include <string_view>

#include "broken/proxy.hpp"

namespace rois::broken {

using Edit = std::function<void(pugi::xml_node root)>;

bool is(std::string const& document, std::string const& name);  // whether the root element is <name>
void replace_all(std::string& text, std::string_view part, std::string_view by);
std::string edited(std::string const& document, Edit const&);
// Returns an answer to this request.
std::string response(std::string const& request, std::string const& return_code, std::string const& children = "");

// Answers `operation` with `return_code` if the gateway answers with `expected`, a return code or the code of a fault.
Breaking answers_with(std::string const& operation, std::string const& expected, std::string const& return_code,
                      std::string const& children = "");
// Answers `operation` with OK, and does not forward it.
Breaking ignores_operation(std::string const& operation);
Breaking edits_answers(std::string const& operation, Edit const&);  // every answer if `operation` is empty
Breaking edits_requests(std::string const& operation, Edit const&);
Breaking edits_notifications(std::string const& name, Edit const&);
// Sends each notification `name` twice.
Breaking repeats(std::string const& name);
void remove_condition(pugi::xml_node root);
// Calls `edit` for every element below `root`. Children come before their parent.
void for_each_below(pugi::xml_node root, Edit const&);

}  // namespace rois::broken

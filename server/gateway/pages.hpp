// The HTML pages that the gateway makes itself: the plain page and the list of schemas.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/engine.hpp"
#include "xml/validation/schemas.hpp"

namespace rois {

// Replaces the marks {{origin}}, {{components}} and {{schemas}} of a page. `host`: the host and port of the gateway.
std::string plain_page(std::string_view page, std::string_view host, std::vector<ComponentEntry> const&,
                       xml::NamedFiles const& schemas);

// The page with links to all schemas.
std::string schema_list_page(xml::NamedFiles const& schemas);

// Returns the text of the page's <style> element. Returns an empty text if there is none.
std::string_view style_of(std::string_view page);

}  // namespace rois

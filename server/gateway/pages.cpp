#include "gateway/pages.hpp"

#include <algorithm>

namespace rois {

namespace {

std::string escaped(std::string_view text) {
    std::string html;
    for (char const c : text) {
        switch (c) {
            case '&':
                html.append("&amp;");
                break;
            case '<':
                html.append("&lt;");
                break;
            case '>':
                html.append("&gt;");
                break;
            case '"':
                html.append("&quot;");
                break;
            default:
                html.push_back(c);
        }
    }
    return html;
}

std::string list_of_links(std::string_view folder, std::vector<std::string> const& names) {
    std::string html = "<ul>\n";
    for (auto const& name : names) {
        auto const shown = escaped(name);
        html.append("<li><a href=\"").append(folder).append(shown).append("\">").append(shown).append("</a></li>\n");
    }
    return html.append("</ul>");
}

std::vector<std::string> names_of(xml::NamedFiles const& files) {
    std::vector<std::string> names;
    for (auto const& [name, text] : files) names.push_back(name);
    return names;
}

std::vector<std::string> names_of(std::vector<ComponentEntry> const& components) {
    std::vector<std::string> names;
    names.reserve(components.size());
    for (auto const& component : components) names.push_back(component.ref);
    return names;
}

void replace_all(std::string& text, std::string_view mark, std::string_view by) {
    for (auto at = text.find(mark); at != std::string::npos; at = text.find(mark, at + by.size()))
        text.replace(at, mark.size(), by);
}

}  // namespace

std::string plain_page(std::string_view page, std::string_view host, std::vector<ComponentEntry> const& components,
                       xml::NamedFiles const& schemas) {
    std::string html{page};
    replace_all(html, "{{origin}}", "http://" + std::string{host});
    replace_all(html, "{{components}}", list_of_links("/rois/profile/", names_of(components)));
    replace_all(html, "{{schemas}}", list_of_links("/rois/schemas/", names_of(schemas)));
    return html;
}

std::string schema_list_page(xml::NamedFiles const& schemas) {
    return "<!doctype html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n<title>RoIS Gateway: schemas</title>\n"
           "<h1>The schemas that this gateway validates with</h1>\n" +
           list_of_links("/rois/schemas/", names_of(schemas)) + "\n</html>\n";
}

std::string_view style_of(std::string_view page) {
    constexpr std::string_view begin = "<style>";
    auto const from = std::min(page.find(begin), page.size());
    auto const to = std::min(page.find("</style>"), page.size());
    return from < to ? page.substr(from + begin.size(), to - from - begin.size()) : std::string_view{};
}

}  // namespace rois

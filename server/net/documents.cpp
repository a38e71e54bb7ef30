#include "net/documents.hpp"

#include <algorithm>

#include "gateway/secrets.hpp"

namespace rois::net {

namespace {

constexpr std::chrono::milliseconds longest_tick{500};  // since the last one, while the engine is healthy

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

// A document that clients may keep as long as they ask whether it has changed.
HttpAnswer versioned(std::string_view content_type, std::string body, RequestHead const& head) {
    HttpAnswer answer;
    auto const etag = '"' + digest(body) + '"';
    answer.cache_control = "no-cache";
    answer.set("ETag", etag);
    if (head.knows(etag)) {
        answer.status = 304;
        answer.content_type = {};
        return answer;
    }
    answer.content_type = content_type;
    answer.body = std::move(body);
    return answer;
}

HttpAnswer plain(std::string body) {
    HttpAnswer answer;
    answer.content_type = "text/plain; charset=utf-8";
    answer.body = std::move(body);
    return answer;
}

HttpAnswer not_found(std::string reason) { return answer_of({FaultCode::not_found, std::move(reason), {}, {}}); }

std::string policy_for_style(std::string_view page) {
    constexpr std::string_view begin = "<style>";
    auto const from = std::min(page.find(begin), page.size());
    auto const to = std::min(page.find("</style>"), page.size());
    auto const style = from < to ? page.substr(from + begin.size(), to - from - begin.size()) : std::string_view{};
    return "default-src 'none'; style-src 'sha256-" + sha256_base64(style) +
           "'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
}

}  // namespace

Documents::Documents(Gateway const& gateway, Telemetry const& telemetry, xml::Schemas const& schemas, Site site)
    : gateway_{gateway},
      telemetry_{telemetry},
      schemas_{schemas.files()},
      site_{std::move(site)},
      style_policy_{policy_for_style(site_.page)} {}

HttpAnswer Documents::answer(Route const& route, RequestHead const& head) const {
    switch (route.endpoint) {
        case Endpoint::page:
            return site_.console.empty() ? page(head) : site_.console.answer("index.html", head);
        case Endpoint::plain_page:
            return page(head);
        case Endpoint::asset:
            return site_.console.answer("assets/" + route.name, head);
        case Endpoint::engine_profile:
            return engine_profile(head);
        case Endpoint::component_profile:
            return component_profile(route.name, head);
        case Endpoint::schema_list:
            return schema_list(head);
        case Endpoint::schema:
            return schema(route.name, head);
        case Endpoint::floor_map:
            return floor_map(head);
        case Endpoint::healthz:
            return health();
        case Endpoint::readyz:
            return readiness();
        case Endpoint::metrics:
            return metrics();
        case Endpoint::rois:
        case Endpoint::stop:
        case Endpoint::clear:
        case Endpoint::notifications:
        case Endpoint::unknown:
            break;
    }
    return not_found("there is nothing here");
}

HttpAnswer Documents::page(RequestHead const& head) const {
    std::string html{site_.page};
    replace_all(html, "{{origin}}", "http://" + std::string{head.host()});
    replace_all(html, "{{components}}", list_of_links("/rois/profile/", names_of(gateway_.components())));
    replace_all(html, "{{schemas}}", list_of_links("/rois/schemas/", names_of(schemas_)));
    auto answer = versioned("text/html; charset=utf-8", std::move(html), head);
    answer.set("Content-Security-Policy", style_policy_);
    answer.set("X-Content-Type-Options", "nosniff");
    answer.set("Referrer-Policy", "no-referrer");
    return answer;
}

HttpAnswer Documents::engine_profile(RequestHead const& head) const {
    auto const profile = gateway_.profile();
    return versioned("application/xml; charset=utf-8", xml::encode(*profile, "engine." + profile->object.name), head);
}

HttpAnswer Documents::component_profile(std::string const& ref, RequestHead const& head) const {
    auto const components = gateway_.components();
    auto const found = std::ranges::find(components, ref, &ComponentEntry::ref);
    if (found == components.end()) return not_found("there is no such component; /rois/profile lists them");
    return versioned("application/xml; charset=utf-8", xml::encode(*found->profile, "profile." + ref), head);
}

HttpAnswer Documents::schema_list(RequestHead const& head) const {
    return versioned("text/html; charset=utf-8",
                     "<!doctype html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n<title>RoIS Gateway: schemas</title>\n"
                     "<h1>The schemas that this gateway validates with</h1>\n" +
                         list_of_links("/rois/schemas/", names_of(schemas_)) + "\n</html>\n",
                     head);
}

HttpAnswer Documents::schema(std::string const& file, RequestHead const& head) const {
    auto const found = schemas_.find(file);
    if (found == schemas_.end()) return not_found("there is no such schema; /rois/schemas lists them");
    return versioned("application/xml; charset=utf-8", std::string{found->second}, head);
}

HttpAnswer Documents::floor_map(RequestHead const& head) const {
    if (site_.floor_map.empty()) return not_found("this engine has no floor map");
    return versioned("application/xml; charset=utf-8", site_.floor_map, head);
}

// Without the engine, which may be locked.
HttpAnswer Documents::health() const {
    if (telemetry_.age_of_last_tick(std::chrono::steady_clock::now()) <= longest_tick) return plain("alive\n");
    auto answer = plain("the engine's clock stands still\n");
    answer.status = 503;
    return answer;
}

HttpAnswer Documents::readiness() const {
    if (gateway_.shutting_down()) return answer_of(shutting_down());
    if (auto answer = health(); answer.status != 200) return answer;
    std::string trouble;
    if (gateway_.everything_is_stopped()) trouble = "stopped: nothing starts until POST /rois/clear\n";
    for (auto const& ref : gateway_.not_ready()) trouble += ref + " has not confirmed that it stands still\n";
    auto answer = plain(trouble.empty() ? "ready\n" : trouble);
    if (!trouble.empty()) answer.status = 503;
    return answer;
}

HttpAnswer Documents::metrics() const {
    auto answer = plain(telemetry_.text(gateway_.statistics()));
    answer.content_type = "text/plain; version=0.0.4; charset=utf-8";
    return answer;
}

}  // namespace rois::net

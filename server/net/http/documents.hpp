// The documents that clients read without a session: profiles, schemas, the floor map, health, metrics and the page at "/".
#pragma once

#include <functional>
#include <string>

#include "gateway/gateway.hpp"
#include "gateway/process/telemetry.hpp"
#include "gateway/web_files.hpp"
#include "xml/validation/schemas.hpp"

namespace rois::net {

struct HttpAnswer;
struct RequestHead;
struct Route;

// Files that are served unchanged, except for the marks of the page.
struct Site {
    std::string_view page;  // HTML with one <style> element, and the marks {{origin}}, {{components}} and {{schemas}}
    WebFiles console{{}};   // at "/"; if it is empty, the page is at "/"
    std::string floor_map;  // an XML document (schemas/map.xsd); empty: the engine has no map
    std::string floor_map_without_robots{};  // for clients that may not see everything
    std::function<std::vector<EngineState>()> engines = [] { return std::vector<EngineState>{}; };  // any thread
};

// A file of the console, compressed if the client accepts that. null: not found.
HttpAnswer file_answer(WebFile const*, RequestHead const&);

// Immutable; any thread. All arguments must outlive it.
class Documents {
public:
    Documents(Gateway const&, Telemetry const&, xml::Schemas const&, Site);

    // Answers a GET or HEAD of every endpoint except /rois and /rois/notifications, with what the asker may see; null:
    // everything.
    HttpAnswer answer(Route const&, RequestHead const&, Principal const* asker) const;

private:
    HttpAnswer page(RequestHead const&, Rights const*) const;
    HttpAnswer component_profile(std::string const& ref, RequestHead const&, Rights const*) const;
    HttpAnswer floor_map(RequestHead const&, Rights const*) const;
    HttpAnswer readiness(Principal const*) const;
    HttpAnswer schema(std::string const& file, RequestHead const&) const;

    Gateway const& gateway_;
    Telemetry const& telemetry_;
    xml::NamedFiles const& schemas_;
    Site site_;
    std::string style_policy_;  // the Content-Security-Policy of the page: allows only its own style
};

}  // namespace rois::net

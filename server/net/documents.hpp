// What can be read without a session: profiles, schemas, the floor map, health, metrics and the page at "/".
#pragma once

#include <memory>
#include <string>

#include "gateway/gateway.hpp"
#include "gateway/telemetry.hpp"
#include "net/http_answer.hpp"
#include "net/http_head.hpp"
#include "net/routes.hpp"
#include "net/web_files.hpp"
#include "xml/validation/schemas.hpp"

namespace rois::net {

// What is served as it is given.
struct Site {
    std::string_view page;  // HTML with one <style> element, and the marks {{origin}}, {{components}} and {{schemas}}
    WebFiles console{{}};   // at "/"; when it is empty, the page is there
    std::string floor_map;  // a document (schemas/map.xsd); empty: the engine has none
};

// Immutable; any thread. All that is given must outlive it.
class Documents {
public:
    Documents(Gateway const&, Telemetry const&, xml::Schemas const&, Site);

    // Answers a GET or HEAD of any endpoint but /rois and /rois/notifications.
    HttpAnswer answer(Route const&, RequestHead const&) const;

private:
    HttpAnswer page(RequestHead const&) const;
    HttpAnswer engine_profile(RequestHead const&) const;
    HttpAnswer component_profile(std::string const& ref, RequestHead const&) const;
    HttpAnswer schema_list(RequestHead const&) const;
    HttpAnswer schema(std::string const& file, RequestHead const&) const;
    HttpAnswer floor_map(RequestHead const&) const;
    HttpAnswer health() const;
    HttpAnswer readiness() const;
    HttpAnswer metrics() const;

    Gateway const& gateway_;
    Telemetry const& telemetry_;
    xml::NamedFiles const& schemas_;
    Site site_;
    std::string style_policy_;  // the Content-Security-Policy that allows the page's own style and nothing else
};

}  // namespace rois::net

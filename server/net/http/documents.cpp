#include "net/http/documents.hpp"

#include <algorithm>

#include "gateway/access/secrets.hpp"
#include "gateway/health.hpp"
#include "gateway/pages.hpp"
#include "net/http/http_answer.hpp"
#include "net/http/http_head.hpp"
#include "net/http/routes.hpp"
#include "types/text/texts.hpp"

namespace rois::net {

namespace {

void secure(HttpAnswer& answer, std::string_view policy) {
    answer.fields.set("Content-Security-Policy", policy);
    answer.fields.set("Referrer-Policy", "no-referrer");
}

// A document that clients may cache if they ask each time whether it has changed.
HttpAnswer versioned(std::string_view content_type, std::string body, RequestHead const& head) {
    auto const etag = '"' + digest(body) + '"';
    HttpAnswer answer{.body = std::move(body), .content_type = content_type, .cache_control = "no-cache"};
    answer.fields.set(http::field::etag, etag);
    return head.knows(etag) ? not_modified(std::move(answer)) : answer;
}

HttpAnswer versioned_xml(std::string body, RequestHead const& head) {
    return versioned("application/xml; charset=utf-8", std::move(body), head);
}

HttpAnswer verdict(std::string const& trouble, std::string_view otherwise) {
    return {.status = trouble.empty() ? http::status::ok : http::status::service_unavailable,
            .body = trouble.empty() ? std::string{otherwise} : trouble,
            .content_type = "text/plain; charset=utf-8"};
}

HttpAnswer not_found(std::string reason) { return answer_of({FaultCode::not_found, std::move(reason)}); }

}  // namespace

HttpAnswer file_answer(WebFile const* file, RequestHead const& head) {
    if (file == nullptr) return not_found("the console has no file " + quoted(head.path));
    // The page itself is short, and compressing it looks like the weakness BREACH of TLS.
    bool const compressed = file->is_asset && !file->compressed.empty() && head.takes_gzip();
    auto const etag = '"' + file->digest + (compressed ? "-gzip\"" : "\"");
    HttpAnswer answer{.body = std::string{compressed ? file->compressed : file->plain}, .content_type = file->content_type};
    answer.cache_control = file->is_asset ? "public, max-age=31536000, immutable" : "no-cache";
    answer.fields.set(http::field::etag, etag);
    answer.fields.set(http::field::vary, "Accept-Encoding");
    secure(answer, console_policy(head.host()));
    if (head.knows(etag)) return not_modified(std::move(answer));
    if (compressed) answer.fields.set(http::field::content_encoding, "gzip");
    return answer;
}

Documents::Documents(Gateway const& gateway, Telemetry const& telemetry, xml::Schemas const& schemas, Site site)
    : gateway_{gateway},
      telemetry_{telemetry},
      schemas_{schemas.files()},
      site_{std::move(site)},
      style_policy_{"default-src 'none'; style-src 'sha256-" + sha256_base64(style_of(site_.page)) +
                    "'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"} {}

HttpAnswer Documents::answer(Route const& route, RequestHead const& head, Principal const* asker) const {
    auto const* rights = asker != nullptr ? asker->rights.get() : nullptr;
    switch (route.endpoint) {
        case Endpoint::page:
            return site_.console.empty() ? page(head, rights) : file_answer(site_.console.find("index.html"), head);
        case Endpoint::plain_page:
            return page(head, rights);
        case Endpoint::asset:
            return file_answer(site_.console.find("assets/" + route.name), head);
        case Endpoint::engine_profile: {
            auto const profile = gateway_.profile(rights);
            return versioned_xml(xml::encode(*profile, "engine." + profile->object.name), head);
        }
        case Endpoint::component_profile:
            return component_profile(route.name, head, rights);
        case Endpoint::schema_list:
            return versioned("text/html; charset=utf-8", schema_list_page(schemas_), head);
        case Endpoint::schema:
            return schema(route.name, head);
        case Endpoint::floor_map:
            return floor_map(head, rights);
        case Endpoint::healthz:
            return verdict(why_not_alive(telemetry_), "alive\n");
        case Endpoint::readyz:
            return readiness(asker);
        case Endpoint::engines:
            return {.body = xml::encode(gateway_.seen_of(site_.engines(), rights))};
        case Endpoint::metrics:
            return {.body = telemetry_.text(gateway_.statistics(rights), gateway_.seen_of(site_.engines(), rights)),
                    .content_type = "text/plain; version=0.0.4; charset=utf-8"};
        default:
            return not_found("there is nothing here");
    }
}

// A client without a token does not learn the names of components.
HttpAnswer Documents::readiness(Principal const* asker) const {
    if (gateway_.shutting_down()) return answer_of(shutting_down());
    auto trouble = why_not_ready(gateway_, telemetry_, asker);
    if (!trouble.empty() && asker != nullptr && asker->role == Role::nobody) trouble = "not ready\n";
    return verdict(trouble, "ready\n");
}

HttpAnswer Documents::floor_map(RequestHead const& head, Rights const* rights) const {
    if (site_.floor_map.empty()) return not_found("this engine has no floor map");
    return versioned_xml(may_see_everything(rights) ? site_.floor_map : site_.floor_map_without_robots, head);
}

HttpAnswer Documents::page(RequestHead const& head, Rights const* rights) const {
    auto html = plain_page(site_.page, head.host(), gateway_.components(rights), schemas_);
    auto answer = versioned("text/html; charset=utf-8", std::move(html), head);
    secure(answer, style_policy_);
    return answer;
}

HttpAnswer Documents::component_profile(std::string const& ref, RequestHead const& head, Rights const* rights) const {
    auto const components = gateway_.components(rights);
    auto const found = std::ranges::find(components, ref, &ComponentEntry::ref);
    if (found == components.end()) return not_found("unknown component " + quoted(ref) + "; /rois/profile lists the components");
    return versioned_xml(xml::encode(*found->profile, "profile." + ref), head);
}

HttpAnswer Documents::schema(std::string const& file, RequestHead const& head) const {
    auto const found = schemas_.find(file);
    if (found == schemas_.end()) return not_found("unknown schema " + quoted(file) + "; /rois/schemas lists the schemas");
    return versioned_xml(std::string{found->second}, head);
}

}  // namespace rois::net

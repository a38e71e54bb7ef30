#include "net/http/routes.hpp"

#include <array>

#include "gateway/access/host_names.hpp"
#include "types/text/text_encoding.hpp"
#include "types/text/texts.hpp"
#include "xml/codec/codec.hpp"

namespace rois::net {

namespace {

struct Named {
    std::string_view path;
    Endpoint endpoint;
};
constexpr std::array<Named, 13> fixed{{{"/", Endpoint::page},
                                       {"/plain", Endpoint::plain_page},
                                       {"/rois", Endpoint::rois},
                                       {"/rois/engines", Endpoint::engines},
                                       {"/rois/notifications", Endpoint::notifications},
                                       {"/rois/profile", Endpoint::engine_profile},
                                       {"/rois/schemas", Endpoint::schema_list},
                                       {"/rois/map", Endpoint::floor_map},
                                       {"/rois/stop", Endpoint::stop},
                                       {"/rois/clear", Endpoint::clear},
                                       {"/healthz", Endpoint::healthz},
                                       {"/readyz", Endpoint::readyz},
                                       {"/metrics", Endpoint::metrics}}};
constexpr std::array<Named, 3> folders{
    {{"/rois/profile/", Endpoint::component_profile}, {"/rois/schemas/", Endpoint::schema}, {"/assets/", Endpoint::asset}}};

std::string_view methods_of(Endpoint endpoint) {
    switch (endpoint) {
        case Endpoint::stop:
        case Endpoint::clear:
            return "POST";
        case Endpoint::rois:
            return "GET, HEAD, POST";
        default:
            return "GET, HEAD";
    }
}

bool is_known_method(std::string_view method) { return method == "GET" || method == "HEAD" || method == "POST"; }

HttpAnswer method_not_allowed(Route const& route, std::string_view method) {
    auto const allowed = std::string{methods_of(route.endpoint)};
    auto const reason = "the method " + quoted(method) + " is not allowed here: expected one of " + allowed;
    auto answer = answer_of({FaultCode::method_not_allowed, reason});
    answer.fields.set(http::field::allow, allowed);
    return answer;
}

}  // namespace

Route route_of(std::string_view path) {
    for (auto const& [fixed_path, endpoint] : fixed) {
        if (path == fixed_path) return {endpoint, {}};
    }
    for (auto const& [folder, endpoint] : folders) {
        if (!path.starts_with(folder)) continue;
        if (auto name = percent_decoded(path.substr(folder.size()))) return {endpoint, std::move(*name)};
    }
    return {};
}

std::string_view name_of(Endpoint endpoint) {
    for (auto const& named : fixed)
        if (named.endpoint == endpoint) return named.path;
    for (auto const& named : folders)
        if (named.endpoint == endpoint) return named.path;
    return {};
}

// A request without Host is HTTP/1.0, which browsers do not send.
std::optional<HttpAnswer> refusal_of_other_sites(RequestHead const& head, Settings const& settings) {
    auto const host = head.field("Host");
    auto foreign = host ? refusal_of_host(*host, settings.hosts) : std::nullopt;
    if (!foreign && !head.target_authority.empty()) foreign = refusal_of_host(head.target_authority, settings.hosts);
    if (foreign) {
        auto answer = answer_of(*foreign);
        answer.status = http::status::misdirected_request;
        return answer;
    }
    if (head.message.count("Origin") == 0) return {};
    auto const origin = head.field("Origin").value_or("");  // empty, which is never allowed, if there are two
    auto const served = settings.credentials ? Scheme::https : Scheme::any;
    auto const refused = refusal_of_origin(origin, head.authority(), settings.allowed_origins, served);
    return refused ? std::optional{answer_of(*refused)} : std::nullopt;
}

bool is_for_everyone(Endpoint endpoint) {
    return endpoint == Endpoint::page || endpoint == Endpoint::asset || endpoint == Endpoint::healthz ||
           endpoint == Endpoint::readyz;
}

Role least_role_for(Endpoint endpoint, RequestHead const& head) {
    if (is_for_everyone(endpoint)) return Role::nobody;
    if (endpoint == Endpoint::stop || endpoint == Endpoint::clear) return Role::operator_;
    bool const joins = endpoint == Endpoint::engines && head.message.count(http::field::upgrade) > 0;
    return joins ? Role::engine : Role::observer;
}

std::optional<HttpAnswer> refusal(RequestHead const& head, Route const& route, Settings const& settings) {
    if (route.endpoint == Endpoint::unknown && is_known_method(head.method()))
        return answer_of({FaultCode::not_found, "unknown path " + quoted(head.path) + ": docs/clients.md lists the paths"});
    bool const is_taken = methods_of(route.endpoint).find(head.method()) != std::string_view::npos;
    if (!is_known_method(head.method()) || !is_taken) return method_not_allowed(route, head.method());
    auto const most = settings.document.bytes;
    if (head.content_length > most)
        return answer_of({FaultCode::too_large, "the body has more than " + std::to_string(most) + " bytes (max_body)"});
    auto const type = head.field("Content-Type").value_or("");
    bool const has_document = head.verb() == http::verb::post && route.endpoint == Endpoint::rois;
    if (!has_document || xml::is_xml_media_type(type)) return {};
    auto const reason = "Content-Type is " + quoted(type) + ": expected application/xml, in UTF-8";
    return answer_of({FaultCode::unsupported_media_type, reason});
}

}  // namespace rois::net

#include "net/http/web_files.hpp"

#include <array>
#include <utility>

#include "gateway/access/secrets.hpp"
#include "net/http/http_answer.hpp"
#include "net/http/http_head.hpp"

namespace rois::net {

namespace {

constexpr std::string_view compressed_form = ".gz";
constexpr std::string_view assets = "assets/";

std::string_view type_of(std::string_view path) {
    static constexpr std::array<std::pair<std::string_view, std::string_view>, 8> types{
        {{".html", "text/html; charset=utf-8"},
         {".js", "text/javascript; charset=utf-8"},
         {".css", "text/css; charset=utf-8"},
         {".json", "application/json"},
         {".webmanifest", "application/manifest+json"},
         {".svg", "image/svg+xml"},
         {".png", "image/png"},
         {".woff2", "font/woff2"}}};
    for (auto const& [ending, type] : types)
        if (path.ends_with(ending)) return type;
    return "application/octet-stream";
}

// Allows only what this gateway serves. Names the WebSocket's address for browsers in which 'self' does not include WebSockets.
std::string policy(RequestHead const& head) {
    std::string const host{head.host()};
    return "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; connect-src 'self' ws://" + host +
           " wss://" + host +
           "; font-src 'self'; manifest-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
}

}  // namespace

WebFiles::WebFiles(xml::NamedFiles const& files) {
    for (auto const& [name, bytes] : files) {
        if (name.ends_with(compressed_form)) continue;
        auto const compressed = files.find(name + std::string{compressed_form});
        files_.emplace(name, File{bytes, compressed == files.end() ? std::string_view{} : compressed->second, digest(bytes)});
    }
}

HttpAnswer WebFiles::answer(std::string_view path, RequestHead const& head) const {
    auto const found = files_.find(path);
    if (found == files_.end()) return answer_of({FaultCode::not_found, "the console has no such file", {}, {}});
    auto const& file = found->second;
    bool const compressed = !file.compressed.empty() && head.takes_gzip();
    auto const etag = '"' + file.digest + (compressed ? "-gzip\"" : "\"");
    HttpAnswer answer{.body = std::string{compressed ? file.compressed : file.plain}, .content_type = type_of(path)};
    answer.cache_control = path.starts_with(assets) ? "public, max-age=31536000, immutable" : "no-cache";
    answer.fields.set(http::field::etag, etag);
    answer.fields.set(http::field::vary, "Accept-Encoding");
    answer.fields.set("Content-Security-Policy", policy(head));
    answer.fields.set("X-Content-Type-Options", "nosniff");
    answer.fields.set("Referrer-Policy", "no-referrer");
    if (head.knows(etag)) return not_modified(std::move(answer));
    if (compressed) answer.fields.set(http::field::content_encoding, "gzip");
    return answer;
}

}  // namespace rois::net

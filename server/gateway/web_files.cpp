#include "gateway/web_files.hpp"

#include <array>
#include <utility>

#include "gateway/access/secrets.hpp"

namespace rois {

namespace {

constexpr std::string_view compressed_form = ".gz";

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

}  // namespace

WebFiles::WebFiles(xml::NamedFiles const& files) {
    for (auto const& [name, bytes] : files) {
        if (name.ends_with(compressed_form)) continue;
        auto const compressed = files.find(name + std::string{compressed_form});
        files_.emplace(name, WebFile{.plain = bytes,
                                     .compressed = compressed == files.end() ? std::string_view{} : compressed->second,
                                     .digest = digest(bytes),
                                     .content_type = type_of(name),
                                     .is_asset = name.starts_with("assets/")});
    }
}

WebFile const* WebFiles::find(std::string_view path) const {
    auto const found = files_.find(path);
    return found == files_.end() ? nullptr : &found->second;
}

// Names the WebSocket's address for browsers in which 'self' does not include WebSockets.
std::string console_policy(std::string_view host) {
    std::string const name{host};
    return "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; connect-src 'self' ws://" + name +
           " wss://" + name +
           "; font-src 'self'; manifest-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
}

}  // namespace rois

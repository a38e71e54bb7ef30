// The files of the web console: its page, and assets whose names change with their content.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "xml/validation/schemas.hpp"

namespace rois {

struct WebFile {
    std::string_view plain;
    std::string_view compressed;  // with gzip; empty: there is no such form
    std::string digest;           // of the plain form
    std::string_view content_type;
    bool is_asset = false;  // its content never changes
};

// Immutable; any thread. The bytes must outlive it.
class WebFiles {
public:
    // By path, "index.html" and "assets/...". A file whose name ends with ".gz" is the compressed form of another file.
    explicit WebFiles(xml::NamedFiles const&);

    bool empty() const { return files_.empty(); }
    // Returns null if there is no such file.
    WebFile const* find(std::string_view path) const;

private:
    std::map<std::string, WebFile, std::less<>> files_;
};

// The Content-Security-Policy of the files: allows only what this gateway serves. `host`: the host and port of the gateway.
std::string console_policy(std::string_view host);

}  // namespace rois

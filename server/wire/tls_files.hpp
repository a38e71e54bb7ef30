// The files for TLS.
#pragma once

#include <string>

namespace rois::tls {

// Names of files in PEM.
struct Files {
    std::string certificate;   // the gateway's own certificate, then those that signed it; empty: no TLS
    std::string key;           // not encrypted
    std::string client_ca;     // certificates that sign those of clients; empty: clients are not asked for one
    bool client_must = false;  // a client without a certificate is refused
};

}  // namespace rois::tls

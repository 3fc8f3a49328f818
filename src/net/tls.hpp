// SPDX-License-Identifier: MIT
// Certificate and private key of a TLS server, checked before it starts.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/result.hpp"

struct ssl_ctx_st;  // OpenSSL's

namespace tribo::net {

// PEM text (RFC 7468): the certificate first, then its chain to a root. The key has no passphrase.
struct TlsKeys {
    std::string certificate_pem, key_pem;
    std::string certificate_file, key_file;  // their names in error messages
};

struct TlsContext {
    std::shared_ptr<ssl_ctx_st> context;  // TLS 1.2 and later
    std::vector<std::string> names;       // hosts and addresses of the certificate, without wildcards
};

// Refuses a file that is no certificate or key, a key of another certificate, a key with a passphrase, a
// certificate that is not valid today and one that is too weak for OpenSSL. The error names file and cause.
Result<TlsContext> make_tls_context(const TlsKeys& keys);

}  // namespace tribo::net

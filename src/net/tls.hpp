// SPDX-License-Identifier: MIT
// The certificate and the key with which a server speaks TLS, checked before it starts.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/result.hpp"

struct ssl_ctx_st;  // OpenSSL's

namespace tribo::net {

// In PEM (RFC 7468): the certificate first, then those that lead from it to a root; a key without passphrase.
struct TlsKeys {
    std::string certificate_pem, key_pem;
    std::string certificate_file, key_file;  // what errors call them
};

struct TlsContext {
    std::shared_ptr<ssl_ctx_st> context;  // TLS 1.2 and later
    std::vector<std::string> names;  // that the certificate vouches for: hosts and addresses, no wildcards
};

// Refuses what is no certificate or key, a key of another certificate or with a passphrase, what is not valid
// today, and what is too weak for OpenSSL, saying which file and why.
Result<TlsContext> make_tls_context(const TlsKeys& keys);

}  // namespace tribo::net

// SPDX-License-Identifier: Apache-2.0
#include "view/access.h"

#include <utility>

namespace hogel::view {
namespace {

std::string bracketed(const std::string& host) { return host.find(':') == std::string::npos ? host : "[" + host + "]"; }

}  // namespace

Access::Access(std::string host, unsigned short port, std::string token)
    : host_(bracketed(host)), port_(":" + std::to_string(port)), token_(std::move(token)) {}

bool Access::is_own_name(std::string_view host) const {
    if (!host.ends_with(port_)) return false;
    host.remove_suffix(port_.size());
    return host == host_ || host == "127.0.0.1" || host == "localhost" || host == "[::1]";
}

std::string Access::refusal_of_page(const Caller& caller) const {
    // With a token the host name is not checked: a machine has many names, and a rebound page does not know the token.
    if (token_.empty() && !is_own_name(caller.host)) return "this server has another name";
    return "";
}

std::string Access::refusal(const Caller& caller) const {
    if (std::string why = refusal_of_page(caller); !why.empty()) return why;
    if (!caller.origin.empty() && caller.origin != "http://" + std::string(caller.host))
        return "the request comes from a page of another server";
    if (!caller.fetch_site.empty() && caller.fetch_site != "same-origin" && caller.fetch_site != "none")
        return "the request comes from a page of another server";
    if (!token_.empty() && !equal_in_constant_time(caller.token, token_))
        return "the address lacks the token that 'hogel view' printed";
    return "";
}

bool equal_in_constant_time(std::string_view a, std::string_view b) {
    unsigned differ = a.size() == b.size() ? 0 : 1;
    for (std::size_t i = 0; i < a.size(); ++i)
        differ |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b.empty() ? 0 : b[i % b.size()]);
    return differ == 0;
}

}  // namespace hogel::view

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace hogel::view {

/// Headers and token that identify the origin of a request.
struct Caller {
    std::string_view host;        ///< header Host
    std::string_view origin;      ///< header Origin; empty: none
    std::string_view fetch_site;  ///< header Sec-Fetch-Site, which browsers send; empty: none
    std::string_view token;       ///< query parameter `token`; empty: none
};

/// Access control. Without a token, only pages that this server sent may request pictures. Requests of pages from other
/// servers are recognised by Origin or Sec-Fetch-Site, and DNS rebinding by Host. With a token, every client that sends
/// the token is admitted, but again no page of another server.
class Access {
  public:
    /// @param host  listening address
    Access(std::string host, unsigned short port, std::string token);

    /// Returns the reason for refusing a request for pictures or facts; empty if the request is admitted.
    std::string refusal(const Caller& caller) const;
    /// Returns the same for the page's static files. They are public: links from other pages may lead to them.
    std::string refusal_of_page(const Caller& caller) const;

  private:
    bool is_own_name(std::string_view host) const;

    std::string host_, port_, token_;
};

/// Compares two texts in a time that does not depend on the position of the first difference.
bool equal_in_constant_time(std::string_view a, std::string_view b);

}  // namespace hogel::view

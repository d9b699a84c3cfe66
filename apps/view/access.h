// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace hogel::view {

/// What a request says of where it comes from.
struct Caller {
    std::string_view host;        ///< header Host
    std::string_view origin;      ///< header Origin; empty: none
    std::string_view fetch_site;  ///< header Sec-Fetch-Site, which browsers send; empty: none
    std::string_view token;       ///< the word `token` of the query; empty: none
};

/// Who may see pictures. Without a token, pages that this server sent to a browser on this machine: a page from
/// elsewhere that makes the browser ask here is known by its Origin or Sec-Fetch-Site, and by its Host where its own
/// name resolves to this machine (DNS rebinding). With a token whoever knows it, but from no other page either.
class Access {
  public:
    /// @param host  the address that is listened on
    Access(std::string host, unsigned short port, std::string token);

    /// Why a request for pictures or facts about them is refused; empty if it is not.
    std::string refusal(const Caller& caller) const;
    /// The same for the page's own files, which are no secret: a link from elsewhere may lead to them.
    std::string refusal_of_page(const Caller& caller) const;

  private:
    bool is_own_name(std::string_view host) const;

    std::string host_, port_, token_;
};

/// Whether two texts are equal, in a time that does not depend on where they differ.
bool equal_in_constant_time(std::string_view a, std::string_view b);

}  // namespace hogel::view

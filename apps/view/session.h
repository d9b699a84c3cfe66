// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "view/viewer.h"

namespace hogel::view {

/// Connection of one page.
class Viewer::Session final : public Conversation {
  public:
    Session(std::weak_ptr<Viewer> viewer, std::weak_ptr<Socket> socket, std::uint64_t pictures, std::uint64_t readings);
    ~Session() override;

    void receive(std::string_view text) override;
    void resume() override;

  private:
    void request_picture(Viewer& viewer, const PictureQuery& query);
    void change(Viewer& viewer, std::map<std::string, std::string> words);
    void request_at_point(Viewer& viewer, const PictureQuery& query, const PickPoint& point, bool focus);

    std::weak_ptr<Viewer> viewer_;
    std::weak_ptr<Socket> socket_;
    std::uint64_t pictures_, readings_;  // client numbers in the workers
    std::optional<PictureQuery> pending_;
};

}  // namespace hogel::view

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "view/viewer.h"

namespace hogel::view {

/// One page that looks.
class Viewer::Session final : public Conversation {
  public:
    Session(std::weak_ptr<Viewer> viewer, std::weak_ptr<Socket> socket, std::uint64_t pictures, std::uint64_t readings);
    ~Session() override;

    void receive(std::string_view text) override;
    void resume() override;

  private:
    void ask(Viewer& viewer, const View& view);
    void change(Viewer& viewer, std::map<std::string, std::string> words);
    void ask_there(Viewer& viewer, const View& view, const PickPoint& point, bool focus);

    std::weak_ptr<Viewer> viewer_;
    std::weak_ptr<Socket> socket_;
    std::uint64_t pictures_, readings_;  // as clients of the workers, which take them in turn
    std::optional<View> held_;
};

}  // namespace hogel::view

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "view/access.h"
#include "view/server.h"
#include "view/subject.h"
#include "view/worker.h"

namespace hogel::view {

/// The site of one light field or hologram: the page, pictures by HTTP, and conversations by WebSocket.
///
/// GET /picture?VIEW answers with a picture, /inside?VIEW&x=0.5&y=0.5&what=hogel with one of what lies there,
/// /reading?VIEW&x=&y= with what is known of it, /sharpness with the contrast of a hologram at many depths. In a
/// conversation the page sends "picture?VIEW", "reading?VIEW&x=&y=" or "focus?VIEW&x=&y="; it gets texts, JSON objects
/// whose `type` is state, reading, focus or error, and pictures: a line of JSON about the picture, a line feed, and the
/// file.
class Viewer final : public Site, public std::enable_shared_from_this<Viewer> {
  public:
    /// @param name   the input as it is named on the command line
    /// @param photo  the command line that photographs it, without the options of the camera
    Viewer(Access access, std::string name, std::string photo);
    ~Viewer() override;

    /// Shows a subject from now on, in place of one that was coarser.
    void show(std::shared_ptr<Subject> subject);
    /// Says how far the work on the next one is: "rendering", 0 to 1. An empty text: it is done.
    void say(const std::string& what, double fraction);

    void answer(const Request& request, std::function<void(Response)> reply) override;
    Response admit(const Request& request) override;
    std::shared_ptr<Conversation> open(std::weak_ptr<Socket> socket) override;

  private:
    class Talk;

    std::shared_ptr<Subject> subject() const;
    std::string state() const;
    void tell(const std::string& text);
    std::string refusal(const Request& request) const;
    void answer_about(const Request& request, const std::function<void(Response)>& reply);

    Access access_;
    std::string name_, photo_;
    mutable std::mutex mutex_;
    std::shared_ptr<Subject> subject_;
    std::string what_ = "opening";
    double fraction_ = 0;
    std::map<std::uint64_t, std::weak_ptr<Socket>> sockets_;
    std::atomic<std::uint64_t> clients_ = 0;
    // Last, so that their threads end before what they use. Waves are slow, and rays and readings do not wait for them.
    Worker rays_, waves_;
};

}  // namespace hogel::view

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <stop_token>
#include <string>
#include <variant>
#include <vector>

#include "view/access.h"
#include "view/server.h"
#include "view/viewable.h"
#include "view/worker.h"

namespace hogel::view {

/// Receives the changes that pages request. Functions are called on the server's thread and must not block.
class Controller {
  public:
    virtual ~Controller() = default;
    /// Changes values of options; the newest wins. @param moving  more changes will follow: a coarse result suffices
    virtual void change(const std::map<std::string, std::string>& options, bool moving) = 0;
    /// Returns the path for a file that a page sends. Throws Error(usage) unless `name` is a plain file name.
    virtual std::filesystem::path destination_for(const std::string& name) = 0;
    /// Opens a file written to that path.
    virtual void open(const std::filesystem::path& file) = 0;
};

/// Site of one light field or hologram: static page, pictures by HTTP, and conversations by WebSocket.
///
/// QUERY is a PictureQuery. GET /picture?QUERY returns a picture, /inside?QUERY&x=0.5&y=0.5&what=hogel a picture of the
/// data at a point, /reading?QUERY&x=&y= its Reading, /sharpness the contrast of a hologram at many depths, /levels its
/// histogram. In a conversation the page sends "picture?QUERY", "reading?QUERY&x=&y=", "focus?QUERY&x=&y=" or
/// "change?hogels=200". It receives texts, which are JSON objects with `type` state, reading, focus, problem or error,
/// and pictures: a line of JSON, a line feed, and the file. POST /drop?name=bunny.ply sends a file and opens it; with
/// &more=yes it is only stored, for the next file.
class Viewer final : public Site, public std::enable_shared_from_this<Viewer> {
  public:
    explicit Viewer(Access access);
    ~Viewer() override;

    /// Sets the receiver of changes; null: changes are ignored.
    void set_controller(Controller* controller);
    /// Replaces the viewable.
    void show(std::shared_ptr<Viewable> viewable);
    /// Sets facts that are added to those of the viewable: its name, the commands that reproduce it.
    void describe(nlohmann::ordered_json facts);
    /// Sends an error to every page. @param parameter  names from Error::parameter()
    void report_error(const std::string& message, const std::vector<std::string>& parameter);
    /// Reports progress to every page: "rendering", 0 to 1. An empty status: done.
    void set_status(const std::string& status, double fraction);

    /// Returns whether a page is open or an answer is pending. Shared work stops otherwise.
    bool is_watched() const;

    bool trusts(const Request& request) const override;
    std::function<void()> answer(const Request& request, std::function<void(Response)> reply) override;
    Response admit(const Request& request) override;
    std::variant<std::filesystem::path, Response> destination_for(const Request& request) override;
    Response take(const Request& request, const std::filesystem::path& file) override;
    std::shared_ptr<Conversation> open(std::weak_ptr<Socket> socket) override;

  private:
    class Session;

    std::shared_ptr<Viewable> viewable() const;
    std::string state() const;
    void tell(const std::string& text);
    std::string refusal(const Request& request) const;
    std::optional<Response> answer_without_viewable(const Request& request) const;
    std::function<void()> answer_about(const Request& request, const std::function<void(Response)>& reply);
    std::function<void()> enqueue(Worker& worker, std::function<void(std::stop_token)> work);
    void forget(std::uint64_t client);

    Access access_;
    mutable std::mutex mutex_;
    Controller* controller_ = nullptr;
    nlohmann::ordered_json description_;
    std::size_t generation_ = 0;  // number of viewables shown
    std::shared_ptr<Viewable> viewable_;
    std::string status_ = "opening";
    double fraction_ = 0;
    std::map<std::uint64_t, std::weak_ptr<Socket>> sockets_;
    std::set<std::uint64_t> http_clients_;  // clients with a pending answer
    std::atomic<std::uint64_t> clients_ = 0;
    // Last members: their threads join before the others are destroyed. Waves are slow: rays and readings have a worker
    // of their own.
    Worker rays_, waves_;
};

}  // namespace hogel::view

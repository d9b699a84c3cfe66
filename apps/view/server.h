// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>
#include <string_view>
#include <variant>

namespace hogel::view {

/// A request. None has a body but those that bring a file, which goes to Site::place_for().
struct Request {
    std::string method, path, query;       ///< "GET", "/picture", "eye=0,0,300mm"
    std::string host, origin, fetch_site;  ///< headers Host, Origin, Sec-Fetch-Site; empty: none
};

struct Response {
    unsigned status = 200;
    std::string type = "text/plain; charset=utf-8";
    std::string body;
};

/// The server's end of a WebSocket. All functions may be called on any thread.
class Socket {
  public:
    virtual ~Socket() = default;
    virtual void send_text(std::string text) = 0;
    /// Sends a picture, which takes the place of one that has not been begun.
    virtual void send_picture(std::string bytes) = 0;
    /// Whether one picture is on its way and another waits, so that making a third would be in vain.
    virtual bool is_busy() const = 0;
};

/// What is said over one WebSocket. Functions are called on the server's thread.
class Conversation {
  public:
    virtual ~Conversation() = default;
    virtual void receive(std::string_view text) = 0;
    /// Called when the socket is no longer busy.
    virtual void resume() = 0;
};

/// What a server serves. Functions are called on the server's thread and return at once.
class Site {
  public:
    virtual ~Site() = default;
    /// Whether who asks may see more than the page's own files. Connections of all others give way to new ones.
    virtual bool trusts(const Request& request) const = 0;
    /// Calls `reply` at most once, on any thread. Returns what stops the work on the answer, after which `reply` need
    /// not be called; the server calls it when the connection closes. Empty: the answer is made.
    virtual std::function<void()> answer(const Request& request, std::function<void(Response)> reply) = 0;
    /// Whether a WebSocket may be opened; `status` 101 if so.
    virtual Response admit(const Request& request) = 0;
    /// Where the file is to be written that a POST brings as its body, or why it is refused.
    virtual std::variant<std::filesystem::path, Response> destination_for(const Request& request) = 0;
    /// Takes that file, which is complete.
    virtual Response take(const Request& request, const std::filesystem::path& file) = 0;
    virtual std::shared_ptr<Conversation> open(std::weak_ptr<Socket> socket) = 0;
};

/// What strangers may cost.
struct ServerLimits {
    std::size_t connections = 128;  ///< at once; a new one closes the oldest that is not trusted or has no request
    std::size_t header = 16384;     ///< bytes of a request
    std::size_t message = 4096;     ///< bytes of a message of a WebSocket
    std::uint64_t body = 0;         ///< bytes of a file that a POST brings
    int body_seconds = 600;         ///< to send it
    int header_seconds = 10;        ///< to send a request
    int idle_seconds = 60;          ///< between two, and to take an answer
};

/// An HTTP and WebSocket server on one thread, with Boost.Beast, which server.cpp alone includes. It knows neither
/// files nor pictures.
class Server {
  public:
    /// Listens. Throws Error(usage) for an address that is not this machine's, or a port that is taken.
    Server(const std::string& host, unsigned short port, const ServerLimits& limits = {});
    ~Server();
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;

    unsigned short port() const;
    /// Serves until a stop is requested. The site must outlive the server's connections, which end when this returns.
    void run(Site& site, const std::stop_token& stop);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace hogel::view

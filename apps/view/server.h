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

/// HTTP request without its body. The body of a POST is a file, written to Site::destination_for().
struct Request {
    std::string method, path, query;       ///< "GET", "/picture", "eye=0,0,300mm"
    std::string host, origin, fetch_site;  ///< headers Host, Origin, Sec-Fetch-Site; empty: none
};

struct Response {
    unsigned status = 200;
    std::string type = "text/plain; charset=utf-8";
    std::string body;
};

/// The server's end of a WebSocket. All functions are thread-safe.
class Socket {
  public:
    virtual ~Socket() = default;
    virtual void send_text(std::string text) = 0;
    /// Sends a picture. It replaces a waiting one whose transmission has not begun.
    virtual void send_picture(std::string bytes) = 0;
    /// Returns true if one picture is being sent and another waits: a third would be dropped.
    virtual bool is_busy() const = 0;
};

/// Message handler of one WebSocket. Functions are called on the server's thread.
class Conversation {
  public:
    virtual ~Conversation() = default;
    virtual void receive(std::string_view text) = 0;
    /// Called when the socket is no longer busy.
    virtual void resume() = 0;
};

/// Request handler of a server. Functions are called on the server's thread and must not block.
class Site {
  public:
    virtual ~Site() = default;
    /// Returns whether the client may see more than the static files. Other connections are closed when a new one needs
    /// their place.
    virtual bool trusts(const Request& request) const = 0;
    /// Calls `reply` at most once, on any thread. Returns a function that cancels the work, which the server calls if
    /// the connection closes first; `reply` need not be called then. Returns an empty function if the reply is
    /// complete.
    virtual std::function<void()> answer(const Request& request, std::function<void(Response)> reply) = 0;
    /// Decides whether a WebSocket may be opened: status 101, or the refusal.
    virtual Response admit(const Request& request) = 0;
    /// Returns the path for the body of a POST, or the refusal.
    virtual std::variant<std::filesystem::path, Response> destination_for(const Request& request) = 0;
    /// Called when that file is complete.
    virtual Response take(const Request& request, const std::filesystem::path& file) = 0;
    virtual std::shared_ptr<Conversation> open(std::weak_ptr<Socket> socket) = 0;
};

/// Limits on resources of clients.
struct ServerLimits {
    std::size_t connections =
        128;                     ///< concurrent; a new one closes the oldest that is untrusted or has sent no request
    std::size_t header = 16384;  ///< bytes of a request
    std::size_t message = 4096;  ///< bytes of a WebSocket message
    std::uint64_t body = 0;      ///< bytes of the body of a POST
    int body_seconds = 600;      ///< to send the body
    int header_seconds = 10;     ///< to send a request header
    int idle_seconds = 60;       ///< between requests, and to receive a response
};

/// HTTP and WebSocket server on one thread. Only server.cpp includes Boost.Beast.
class Server {
  public:
    /// Starts listening. Throws Error(usage) if the address is not local or the port is in use.
    Server(const std::string& host, unsigned short port, const ServerLimits& limits = {});
    ~Server();
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;

    unsigned short port() const;
    /// Serves until a stop is requested. All connections end before it returns; the site must live until then.
    void run(Site& site, const std::stop_token& stop);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace hogel::view

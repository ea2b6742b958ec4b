// SPDX-License-Identifier: GPL-3.0-or-later
// A program's page in the user's browser: HTTP and WebSocket on 127.0.0.1, for whoever knows the
// token.
#pragma once

#include <memory>
#include <string>

#include "calibration/web/loopback_server_options.h"

namespace insitu {

class LoopbackServer {
 public:
  // From now on connections are accepted by the system, threads run (block signals before that are
  // waited for), and SIGPIPE is ignored by this process. Throws InputError: the port is taken.
  LoopbackServer(LoopbackServerOptions options, LoopbackServerCallbacks callbacks);
  ~LoopbackServer();

  int port() const;
  std::string address() const;  // "http://127.0.0.1:PORT/"

  void Run();   // serves until Stop; once
  void Stop();  // from any thread, callbacks too; requests that are being answered end first

  // From any thread; never wait. A window that does not read is closed: its page connects anew.
  void Send(std::string text);  // to all windows, in the same order
  void SendTo(int window, std::string text);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace insitu

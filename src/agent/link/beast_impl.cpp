// SPDX-License-Identifier: Apache-2.0
// Beast and Asio, compiled once for the agent.
#include <boost/asio/impl/src.hpp>
#include <boost/asio/ssl/impl/src.hpp>
#include <boost/beast/src.hpp>

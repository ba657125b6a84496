/// The last messages of a node that ends by itself: roscpp tells nobody when a message has left, and a node
/// that ends throws away what has not.
#pragma once

namespace sunlit::ros_interface {

/// Waits until all that this process has published is with its readers: read, or, where these are on other
/// machines, in the buffers of their sockets. Unread bytes of this machine do not count as delivered, since
/// roscpp throws them away as it learns that the publisher has left. Gives up when no reader has taken
/// anything for 30 s, with a warning that says how much is lost, or when ROS shuts down or
/// isInterrupted(). Needs a node handle, and that nothing is published meanwhile.
void deliverTheLast();

}  // namespace sunlit::ros_interface

// A process that keeps a program and everything that the program starts together: it ends when the program ends, when it gets
// SIGTERM or when its parent dies, and then no descendant of the program is left, not even one that detached itself.
#pragma once

#include <sys/types.h>

namespace rendering::models {

/// To call in a new child process of `parent`, which stays behind as the keeper. Returns in a child of the keeper, which becomes
/// the program. The keeper ends with the status of the program; `report` is closed in it, and
/// every other descriptor but the three streams. Calls only functions that are safe in
/// signal handlers, because the new process may be a copy of a process with several threads.
void stayBehindAsKeeper(pid_t parent, int report);

}  // namespace rendering::models

// Checks of a parsed command line: what it must not overwrite, and what it must not leave empty.
#pragma once

namespace CLI {
class App;
}

namespace study::commands {

/// Looks at the outputs of the parsed command (--out, --json, --csv, --images and the like). Throws badInput for one that would
/// lie in a study folder, where it could replace the database or a key, and for one that is a file that the command reads, or a
/// file of a data set that it reads.
void requireSafeOutputs(const CLI::App& app);

/// Throws badInput for an argument that is there and empty, as in `--against "$HEAD"` where HEAD is not set. Without this a check
/// would silently not be made.
void requireFilledArguments(const CLI::App& app);

}  // namespace study::commands

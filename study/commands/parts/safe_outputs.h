// What a command line must not overwrite.
#pragma once

namespace CLI {
class App;
}

namespace study::commands {

/// Looks at the outputs of the parsed command (--out, --json, --csv, --images and the like). Throws badInput for one that would
/// lie in a study folder, where it could replace the database or a key, and for one that is a file that the command reads, or a
/// file of a data set that it reads.
void requireSafeOutputs(const CLI::App& app);

}  // namespace study::commands

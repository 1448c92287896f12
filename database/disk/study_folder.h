// The names of the files in a study folder.
#pragma once

#include <filesystem>
#include <string>

namespace database {

struct StudyFolder {
    std::filesystem::path folder;

    std::filesystem::path database() const { return folder / "study.db"; }
    std::filesystem::path protocol() const { return folder / "protocol.json"; }
    std::filesystem::path stimuli() const { return folder / "stimuli"; }
    std::filesystem::path prompts() const { return folder / "prompts"; }
    /// The recording of a prompt, by its key in the protocol.
    std::filesystem::path prompt(const std::string& key) const { return prompts() / (key + ".wav"); }
    std::filesystem::path allocationKey() const { return folder / "allocation-key.json"; }
    std::filesystem::path sealedAllocationKey() const { return folder / "allocation-key.sealed"; }
    std::filesystem::path stationKey() const { return folder / "station-key.json"; }
    std::filesystem::path maskedKey() const { return folder / "masked-key.json"; }  ///< up to version 0.6.0
    std::filesystem::path upgrade() const { return folder / ".upgrade"; }           ///< what an upgrade prepares
    std::filesystem::path beforeUpgrade() const { return folder / "before-upgrade"; }

    std::filesystem::path queue() const { return folder / "queue.db"; }  ///< answers that wait for the server
    std::filesystem::path lock() const { return folder / ".lock"; }
};

}  // namespace database

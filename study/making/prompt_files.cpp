#include "study/making/prompt_files.h"

#include "protocols/files/folder_draft.h"
#include "protocols/files/whole_file.h"
#include "study/participant/sound/wav_sound.h"

namespace study::making {

std::map<std::string, std::string> readPrompts(const protocols::Protocol& protocol, const std::filesystem::path& protocolFile)
{
    std::map<std::string, std::string> prompts;
    for (const auto& [key, name] : protocol.prompts) {
        const std::filesystem::path file = protocolFile.parent_path() / name;
        std::string bytes = protocols::readWholeFile(file, participant::largestWav);
        participant::soundFromWav(bytes, file.string());  // a recording that cannot be played must not wait for the session
        prompts[key] = std::move(bytes);
    }
    return prompts;
}

void writePrompts(const database::StudyFolder& folder, const std::map<std::string, std::string>& prompts)
{
    if (prompts.empty()) return;
    protocols::makeFolders(folder.prompts(), protocols::Sync::Later);
    for (const auto& [key, bytes] : prompts) protocols::writeWholeFile(folder.prompt(key), bytes, protocols::Sync::Later);
}

}  // namespace study::making

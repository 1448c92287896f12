#include "study/records/shown_origin.h"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "protocols/files/strict_json.h"

namespace study::records {

namespace {

using nlohmann::ordered_json;

constexpr std::size_t shownDigits = 12;

std::string withHash(const std::string& file, const ordered_json& sha256)
{
    return std::filesystem::path(file).filename().string() + " (SHA-256 " + sha256.get<std::string>().substr(0, shownDigits) +
           "…)";
}

}  // namespace

std::string shownMadeWith(const database::StudyStore& store, const database::StudyFacts& facts)
{
    if (store.unblinding()) return facts.madeWith;
    ordered_json made = protocols::storedOrderedJson(facts.madeWith);
    if (!made.is_object()) return facts.madeWith;
    for (const char* own : {"own_images_sha256", "programs"}) made.erase(own);
    return made.dump();
}

std::vector<std::string> programSentences(const database::StudyStore& store, const database::StudyFacts& facts)
{
    std::vector<std::string> sentences;
    const ordered_json made = protocols::storedOrderedJson(facts.madeWith);
    if (!store.unblinding() || !made.is_object() || !made.contains("programs")) return sentences;
    try {
        for (const auto& [condition, used] : made.at("programs").items()) {
            std::string text = "The images of condition " + condition + " come from " +
                               withHash(used.at("program").get<std::string>(), used.at("sha256"));
            for (const auto& [file, sha256] : used.at("files_sha256").items()) text += " with " + withHash(file, sha256);
            sentences.push_back(text + ".");
        }
    } catch (const ordered_json::exception&) {
        sentences.clear();  // `verify` finds an altered study.
    }
    return sentences;
}

}  // namespace study::records

#include "study/records/evidence/signed_head.h"

#include <charconv>
#include <nlohmann/json.hpp>

#include "database/stored_texts.h"
#include "protocols/files/errors.h"
#include "protocols/files/safe_text.h"
#include "protocols/files/strict_json.h"
#include "protocols/files/utf8.h"
#include "protocols/secrets/sealing.h"
#include "protocols/secrets/signing.h"
#include "study/records/log_heads.h"

namespace study::records {

namespace {

constexpr std::string_view firstLine = "vis2hap signed head 1\n";
constexpr std::string_view signatureName = "signature: ";
constexpr const char* keySchema = "vis2hap.signing-key/1";
constexpr const char* keyAlgorithm = "Ed25519";
constexpr const char* takeTheOriginal = "take the original file, or make a new key with `vis2hap study signing-key`";

std::string line(const std::string& name, const std::string& value) { return name + ": " + protocols::printable(value) + "\n"; }

protocols::Error malformed(const std::string& what, const std::string& where)
{
    return protocols::badInput(
        {what, where, "the file as `vis2hap study sign` wrote it", "take the original file, or sign the head again"});
}

/// The value of the line that begins with `name: `; takes the line off the text.
std::string takeLine(std::string_view& text, const std::string& name, const std::string& where)
{
    const std::size_t end = text.find('\n');
    const std::string begin = name + ": ";
    if (end == std::string_view::npos || !text.starts_with(begin))
        throw malformed("the signed statement has no line \"" + name + "\" in its place", where);
    const std::string value(text.substr(begin.size(), end - begin.size()));
    text.remove_prefix(end + 1);
    return value;
}

/// Mail programs and editors of Windows end lines with carriage returns and write a mark of the byte order.
std::string withLineFeeds(std::string_view file)
{
    const std::string_view bytes = protocols::withoutByteOrderMark(file);
    std::string text;
    text.reserve(bytes.size());
    for (std::size_t at = 0; at < bytes.size(); ++at)
        if (!bytes.substr(at).starts_with("\r\n")) text += bytes[at];
    return text;
}

database::LogHead headFrom(const std::string& text, const std::string& where)
{
    database::LogHead head;
    const char* end = text.data() + text.size();
    const auto [colon, fault] = std::from_chars(text.data(), end, head.sequence);
    if (fault != std::errc() || colon == end || *colon != ':') throw malformed("the signed statement has no head", where);
    head.hash.assign(colon + 1, end);
    constexpr std::size_t hashLength = 64;  // SHA-256 in hexadecimal
    if (head.hash.size() != hashLength || head.hash.find_first_not_of("0123456789abcdef") != std::string::npos)
        throw malformed("the head of the signed statement is not whole", where);
    return head;
}

protocols::Error noSigningKey(const std::string& where)
{
    return protocols::badInput({"this is no signing key", where,
                                std::string("a file of `vis2hap study signing-key`, \"schema\": \"") + keySchema + "\"",
                                "name the key of the laboratory, not its public key"});
}

}  // namespace

std::string signedHeadText(const database::StudyStore& store, const protocols::SecretKey& seed, const std::string& program)
{
    requireLastingHead(store);
    const auto head = store.head();
    std::string text(firstLine);
    text += line("study", store.facts().name);
    text += line("study id", store.hashOfEntry(1));
    text += line("head", textOf(head));
    text += line("entries", std::to_string(head.sequence));
    text += line("time", database::wallTimeNow());
    text += line("program", program);
    text += line("public key", protocols::publicKeyOf(seed));
    return text + std::string(signatureName) + protocols::signatureOf(seed, text) + "\n";
}

std::optional<SignedHead> signedHeadIn(const std::string& file, const std::string& where)
{
    const std::string text = withLineFeeds(file);
    if (!text.starts_with(firstLine)) {
        if (text.find(firstLine) != std::string::npos) throw malformed("the signed statement does not begin the file", where);
        return std::nullopt;
    }
    SignedHead found;
    std::string_view rest = std::string_view(text).substr(firstLine.size());
    found.study = takeLine(rest, "study", where);
    found.studyId = takeLine(rest, "study id", where);
    found.head = headFrom(takeLine(rest, "head", where), where);
    if (takeLine(rest, "entries", where) != std::to_string(found.head.sequence))
        throw malformed("the signed statement names two numbers of entries", where);
    found.time = takeLine(rest, "time", where);
    found.program = takeLine(rest, "program", where);
    found.publicKey = takeLine(rest, "public key", where);
    found.statement = text.substr(0, text.size() - rest.size());
    found.signature = takeLine(rest, "signature", where);
    if (!rest.empty()) throw malformed("the signed statement has lines after its signature", where);
    return found;
}

std::string faultOfSignature(const SignedHead& head, const std::string& publicKey, const database::StudyStore& store)
{
    if (head.publicKey != publicKey)
        return "the statement was signed with another key, " + protocols::printable(head.publicKey.substr(0, 16)) +
               "... (expected " + publicKey.substr(0, 16) + "...)";
    if (!protocols::isSignedBy(publicKey, head.statement, head.signature))
        return "the statement was altered after it was signed, or the signature was";
    if (head.studyId != store.hashOfEntry(1)) return "the statement is about another study, " + protocols::printable(head.study);
    return {};
}

std::string signingKeyText(const protocols::SecretKey& seed, const std::optional<std::string>& passphrase)
{
    const std::string text =
        nlohmann::ordered_json{
            {"schema", keySchema}, {"algorithm", keyAlgorithm}, {"public_key", protocols::publicKeyOf(seed)}, {"key", seed.hex()}}
            .dump(2) +
        "\n";
    return passphrase ? protocols::sealWithPassphrase(*passphrase, text) : text;
}

protocols::SecretKey signingKeyOf(const std::string& text, const std::string& where,
                                  const std::function<std::optional<std::string>()>& passphrase)
{
    nlohmann::json document = protocols::parseStrictJson(text, where);
    const auto schemaOf = [&] { return document.is_object() ? document.value("schema", nlohmann::json()) : nlohmann::json(); };
    if (schemaOf() == "vis2hap.sealed/1") {
        const auto given = passphrase();
        const auto opened = given ? protocols::openWithPassphrase(*given, text, where) : std::nullopt;
        if (!opened)
            throw protocols::badInput(
                {given ? "the passphrase does not open the signing key" : "the signing key has a passphrase", where,
                 "the passphrase that was given when the key was made", "give it with --passphrase-file FILE"});
        document = protocols::parseStrictJson(*opened, where);
    }
    if (schemaOf() != keySchema || !document.contains("key") || !document["key"].is_string()) throw noSigningKey(where);
    if (document.value("algorithm", nlohmann::json()) != keyAlgorithm)
        throw protocols::badInput({"the signing key is for another algorithm", where,
                                   std::string("\"algorithm\": \"") + keyAlgorithm + "\"", takeTheOriginal});
    const auto seed = protocols::SecretKey::ofHex(document["key"].get<std::string>(), where);
    if (document.value("public_key", nlohmann::json()) != protocols::publicKeyOf(seed))
        throw protocols::badInput({"\"public_key\" of the signing key is not that of its \"key\"", where,
                                   "both as `vis2hap study signing-key` wrote them", takeTheOriginal});
    return seed;
}

}  // namespace study::records

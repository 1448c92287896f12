// Keys of a session: each act has a standard key, and the operator may give it another one beside it, for a foot pedal or a
// switch that the computer takes for a keyboard. The standard key always acts.
#pragma once

#include <QString>
#include <map>
#include <optional>
#include <vector>

class QSettings;

namespace study::app {

enum class KeyAct { Confirm, Touch, AnswerBegins, Correct, Note, Flag, Void, Pause, Stop, Withdraw };

struct ActOfKey {
    KeyAct act;
    const char* id;   ///< in the settings
    int standardKey;  ///< Qt::Key
    QString words;    ///< "Store the answer, confirm the tray, go on"
};
/// All acts, in the order of the page.
std::vector<ActOfKey> actsOfKeys();

/// "Enter", "Esc", "T", "F13", "Page Down".
QString nameOfKey(int key);

class KeyBindings {
public:
    std::optional<int> extraKey(KeyAct act) const;
    /// The standard key of the act that has this extra key; else the key itself.
    int meantBy(int key) const;
    bool isExtraKey(int key) const { return meantBy(key) != key; }

    /// Why the key cannot be given to the act, as a sentence that names what clashes; empty if it can. Free are keys that write
    /// nothing, edit nothing, and belong to no other act.
    QString faultOf(KeyAct act, int key) const;
    /// Gives the act this extra key, unless faultOf() names a fault. Returns the fault.
    QString bind(KeyAct act, int key);
    void unbind(KeyAct act) { m_extra.erase(act); }

    /// "Enter", or "Enter or F13".
    QString keysOf(KeyAct act) const;
    /// "Store the answer (Enter or F13)".
    QString withKeys(const QString& text, KeyAct act) const;

    bool operator==(const KeyBindings&) const = default;

private:
    std::map<KeyAct, int> m_extra;
};

/// Bindings in the settings that clash, or that are no keys, are left out. `settings` may be null.
KeyBindings rememberedKeys(const QSettings* settings);
void rememberKeys(QSettings* settings, const KeyBindings& keys);

}  // namespace study::app

#include "study/app/state/key_bindings.h"

#include <QKeySequence>
#include <QSettings>
#include <algorithm>

#include "study/app/language/app_text.h"

namespace study::app {

namespace {

const QString groupOfKeys = QStringLiteral("extraKeys/");

/// Keys that edit a field, move in it, or change what another key means.
constexpr int editingKeys[] = {Qt::Key_Return, Qt::Key_Enter,   Qt::Key_Tab,      Qt::Key_Backtab, Qt::Key_Backspace,
                               Qt::Key_Delete, Qt::Key_Home,    Qt::Key_End,      Qt::Key_Left,    Qt::Key_Right,
                               Qt::Key_Up,     Qt::Key_Down,    Qt::Key_Shift,    Qt::Key_Control, Qt::Key_Meta,
                               Qt::Key_Alt,    Qt::Key_AltGr,   Qt::Key_CapsLock, Qt::Key_NumLock, Qt::Key_Escape,
                               Qt::Key_Space,  Qt::Key_unknown, Qt::Key_Multi_key};

/// Qt numbers the keys that write a character by the character.
bool writes(int key) { return key < Qt::Key_Escape; }

/// Dead keys and the keys of input methods write, too.
bool composes(int key) { return key >= Qt::Key_AltGr && key < Qt::Key_MediaLast; }

bool isStandardKey(const ActOfKey& one, int key)
{
    return one.standardKey == key || (one.act == KeyAct::Pause && key == Qt::Key_P);
}

}  // namespace

std::vector<ActOfKey> actsOfKeys()
{
    return {{KeyAct::Confirm, "confirm", Qt::Key_Return, AppText::tr("Confirm the tray, store the answer, go on")},
            {KeyAct::Touch, "touch", Qt::Key_T, AppText::tr("Stamp the first touch")},
            {KeyAct::AnswerBegins, "answerBegins", Qt::Key_F9, AppText::tr("The answer begins (the spoken word)")},
            {KeyAct::Correct, "correct", Qt::Key_L, AppText::tr("Correct a stored answer")},
            {KeyAct::Note, "note", Qt::Key_N, AppText::tr("Write a note")},
            {KeyAct::Flag, "flag", Qt::Key_F, AppText::tr("Flag the presentation")},
            {KeyAct::Void, "void", Qt::Key_V, AppText::tr("Void the presentation")},
            {KeyAct::Pause, "pause", Qt::Key_Escape, AppText::tr("Pause")},
            {KeyAct::Stop, "stop", Qt::Key_Q, AppText::tr("Stop for now")},
            {KeyAct::Withdraw, "withdraw", Qt::Key_W, AppText::tr("Withdrawal of the participant")}};
}

QString nameOfKey(int key)
{
    if (key == Qt::Key_Return) return AppText::tr("Enter");
    if (key == Qt::Key_PageDown) return AppText::tr("Page Down");
    if (key == Qt::Key_PageUp) return AppText::tr("Page Up");
    return QKeySequence(key).toString(QKeySequence::NativeText);
}

std::optional<int> KeyBindings::extraKey(KeyAct act) const
{
    const auto found = m_extra.find(act);
    return found == m_extra.end() ? std::nullopt : std::optional(found->second);
}

int KeyBindings::meantBy(int key) const
{
    for (const ActOfKey& one : actsOfKeys())
        if (extraKey(one.act) == key) return one.standardKey;
    return key;
}

QString KeyBindings::faultOf(KeyAct act, int key) const
{
    for (const ActOfKey& one : actsOfKeys()) {
        if (isStandardKey(one, key))
            return AppText::tr("%1 is the standard key of “%2”. Press another key.").arg(nameOfKey(key), one.words);
        if (one.act != act && extraKey(one.act) == key)
            return AppText::tr("%1 acts as “%2” already. Press another key, or remove it there first.")
                .arg(nameOfKey(key), one.words);
    }
    if (std::ranges::find(editingKeys, key) != std::end(editingKeys))
        return AppText::tr("This key moves or edits in a field. Press another key, such as F13 or Page Down.");
    if (key <= 0 || writes(key) || composes(key) || nameOfKey(key).isEmpty())
        return AppText::tr("This key writes a character, and characters are answers. Set the pedal to another key, such as F13.");
    return {};
}

QString KeyBindings::bind(KeyAct act, int key)
{
    const QString fault = faultOf(act, key);
    if (fault.isEmpty()) m_extra[act] = key;
    return fault;
}

QString KeyBindings::keysOf(KeyAct act) const
{
    QString names;
    for (const ActOfKey& one : actsOfKeys())
        if (one.act == act) names = one.act == KeyAct::Pause ? AppText::tr("Esc") : nameOfKey(one.standardKey);
    const auto extra = extraKey(act);
    return extra ? AppText::tr("%1 or %2").arg(names, nameOfKey(*extra)) : names;
}

QString KeyBindings::withKeys(const QString& text, KeyAct act) const { return AppText::tr("%1 (%2)").arg(text, keysOf(act)); }

KeyBindings rememberedKeys(const QSettings* settings)
{
    KeyBindings keys;
    if (!settings) return keys;
    for (const ActOfKey& one : actsOfKeys()) {
        bool isNumber = false;
        const int key = settings->value(groupOfKeys + QLatin1String(one.id)).toInt(&isNumber);
        if (isNumber && key != 0) keys.bind(one.act, key);
    }
    return keys;
}

void rememberKeys(QSettings* settings, const KeyBindings& keys)
{
    if (!settings) return;
    for (const ActOfKey& one : actsOfKeys()) {
        const QString place = groupOfKeys + QLatin1String(one.id);
        if (const auto extra = keys.extraKey(one.act))
            settings->setValue(place, *extra);
        else
            settings->remove(place);
    }
}

}  // namespace study::app

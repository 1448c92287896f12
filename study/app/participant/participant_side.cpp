#include "study/app/participant/participant_side.h"

#include <QRandomGenerator>

#include "protocols/files/errors.h"
#include "protocols/usual_texts.h"
#include "study/app/language/below.h"

namespace study::app {

using namespace participant;

namespace {

constexpr int usualPort = 8577;
constexpr int restartMs = 300;
constexpr int mostFailures = 5;
constexpr int soundMs = 10'000;  ///< a program that ran this long can be started again

QString drawnCode()
{
    constexpr quint32 codes = 1'000'000;
    return QString::number(QRandomGenerator::system()->bounded(codes)).rightJustified(6, QLatin1Char('0'));
}

QString pageAddress(const QString& address, int port)
{
    const bool isVersion6 = address.contains(QLatin1Char(':'));
    return QStringLiteral("http://%1:%2").arg(isVersion6 ? QLatin1Char('[') + address + QLatin1Char(']') : address).arg(port);
}

}  // namespace

ParticipantSide::ParticipantSide(QObject* parent) : QObject(parent), m_process(new LineProcess(this)), m_again(new QTimer(this))
{
    m_sinceShown.start();
    m_again->setSingleShot(true);
    connect(m_again, &QTimer::timeout, this, &ParticipantSide::launch);
    connect(m_process, &LineProcess::lineRead, this, &ParticipantSide::hear);
    connect(m_process, &LineProcess::ended, this, &ParticipantSide::recover);
    setWords({});
}

void ParticipantSide::setWords(const protocols::Protocol& protocol)
{
    PageTexts texts{protocol.language, {}};
    for (const auto& [key, text] : protocols::usualParticipantTexts(protocol.language))
        texts.texts[key] = participantText(protocol, key);
    if (texts == m_texts) return;
    m_texts = std::move(texts);
    tell(m_texts);
}

void ParticipantSide::show(const Instruction& instruction)
{
    if (isSameApartFromTheClock(instruction, m_shown.instruction) && m_shown.number > 0) return;
    m_shown = {m_shown.number + 1, instruction};
    m_sinceShown.start();
    tell(m_shown);
    Q_EMIT instructionChanged();
}

int ParticipantSide::breakSeconds() const
{
    const auto& before = m_shown.instruction.breakSeconds;
    return before ? *before + static_cast<int>(m_sinceShown.elapsed() / 1000) : 0;
}

void ParticipantSide::startPage(const QString& address)
{
    stopPage();
    m_listenAddress = address;
    m_state.isOn = true;
    m_state.code = drawnCode();
    launch();
}

void ParticipantSide::stopPage()
{
    m_again->stop();
    m_process->stop();
    m_state = {};
    m_sessionHash.clear();
    m_port = 0;
    m_failuresInARow = 0;
    Q_EMIT stateChanged();
}

void ParticipantSide::drawCode()
{
    if (!m_state.isOn) return;
    m_sessionHash.clear();
    m_state.device.clear();
    m_state.refused.clear();
    m_state.wrongCodes = 0;
    m_state.code = drawnCode();
    tell(NewCode{m_state.code.toStdString()});
    Q_EMIT stateChanged();
}

void ParticipantSide::launch()
{
    m_sinceLaunch.start();
    try {
        const QString port = QString::number(m_port == 0 ? usualPort : m_port);
        // Nothing of this program's surroundings concerns a page that strangers can reach.
        m_process->start(QStringLiteral("vis2hap-page"),
                         {QStringLiteral("--address"), m_listenAddress, QStringLiteral("--port"), port},
                         ProgramSurroundings::None);
        m_state.fault.clear();
    } catch (const protocols::Error& fault) {
        m_state.fault = inOwnLanguage(fault.what());
        Q_EMIT stateChanged();
        return;
    }
    tell(m_texts);
    if (!m_state.code.isEmpty()) tell(NewCode{m_state.code.toStdString()});
    if (!m_sessionHash.empty()) tell(KnownDevice{m_sessionHash});
    NumberedInstruction present = m_shown;
    if (present.instruction.breakSeconds) present.instruction.breakSeconds = breakSeconds();
    tell(present);
    Q_EMIT stateChanged();
}

void ParticipantSide::tell(const LineToPage& line) { m_process->send(lineOf(line)); }

void ParticipantSide::hear(const std::string& text)
{
    try {
        take(lineFromPage(text));
    } catch (const protocols::Error& fault) {
        m_process->fail(inOwnLanguage(fault.what()));
    }
}

void ParticipantSide::take(const LineFromPage& line)
{
    if (const auto* act = std::get_if<ParticipantAct>(&line)) {
        // A second tap on the same button arrives when the page shows the next instruction.
        if (act->number == m_shown.number && isAskedFor(*act, m_shown.instruction)) Q_EMIT acted(*act);
        return;
    }
    if (const auto* listening = std::get_if<Listening>(&line)) {
        m_port = listening->port;
        m_state.address = pageAddress(m_listenAddress, m_port);
    } else if (const auto* device = std::get_if<DeviceEntered>(&line)) {
        m_sessionHash = device->sessionHash;
        m_state.device = QString::fromStdString(device->from);
        m_state.code.clear();
    } else if (const auto* wrong = std::get_if<WrongCodeEntered>(&line)) {
        m_state.wrongCodes = wrong->tries;
        if (wrong->isVoid) m_state.code.clear();
    } else if (const auto* refused = std::get_if<DeviceRefused>(&line)) {
        m_state.refused = QString::fromStdString(refused->from);
    }
    Q_EMIT stateChanged();
}

void ParticipantSide::recover(const QString& why)
{
    m_state.fault = tr("The participant's page has stopped: %1").arg(why);
    if (m_sinceLaunch.elapsed() > soundMs) m_failuresInARow = 0;
    // The session does not need the page. A page that ends again and again waits for the operator.
    if (++m_failuresInARow <= mostFailures) {
        // Tries at the code must not begin anew with each start of the program.
        if (m_sessionHash.empty() && !m_state.code.isEmpty()) m_state.code = drawnCode();
        m_again->start(restartMs);
    } else {
        m_state.address.clear();
    }
    Q_EMIT stateChanged();
}

}  // namespace study::app

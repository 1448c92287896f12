<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="zh_CN">
<context>
    <name>study::app::AnalysisSection</name>
    <message>
        <source>Lower bound of equivalence</source>
        <translation>等效下限</translation>
    </message>
    <message>
        <source>Upper bound of equivalence</source>
        <translation>等效上限</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>移除</translation>
    </message>
    <message>
        <source>Make it the primary one</source>
        <translation>设为主要对比</translation>
    </message>
    <message>
        <source>First condition of the contrast</source>
        <translation>对比的第一个条件</translation>
    </message>
    <message>
        <source>Second condition of the contrast</source>
        <translation>对比的第二个条件</translation>
    </message>
    <message>
        <source>Add the contrast</source>
        <translation>添加对比</translation>
    </message>
    <message>
        <source>Analysis</source>
        <translation>分析</translation>
    </message>
    <message>
        <source>Decide before the first participant comes what the report tests first, and which difference is too small to matter.</source>
        <translation>请在第一位参与者到来之前决定：报告首先检验什么，多小的差异没有实际意义。</translation>
    </message>
    <message>
        <source>Equal from (scale points)</source>
        <translation>等效范围从（量表分）</translation>
    </message>
    <message>
        <source>to (scale points)</source>
        <translation>到（量表分）</translation>
    </message>
    <message>
        <source>Bounds of equivalence</source>
        <translation>等效界限</translation>
    </message>
    <message>
        <source>Planned contrasts</source>
        <translation>计划对比</translation>
    </message>
    <message>
        <source>Pairs of conditions. The primary one is tested first; without a choice it is the first.</source>
        <translation>成对的条件。首先检验主要对比；如果没有选择，则为第一对。</translation>
    </message>
    <message>
        <source>Primary contrast</source>
        <translation>主要对比</translation>
    </message>
    <message>
        <source>%1 − %2</source>
        <translation>%1 − %2</translation>
    </message>
    <message>
        <source>%1    (primary)</source>
        <translation>%1    （主要）</translation>
    </message>
    <message>
        <source>Both conditions are the same. Choose two different ones.</source>
        <translation>两个条件相同。请选择两个不同的条件。</translation>
    </message>
    <message>
        <source>This pair is planned already. Choose another one.</source>
        <translation>这一对已经列入计划。请选择另一对。</translation>
    </message>
</context>
<context>
    <name>study::app::AppText</name>
    <message>
        <source>.</source>
        <comment>decimal mark</comment>
        <translation>.</translation>
    </message>
    <message>
        <source>The disk of %1 cannot be asked for its room.</source>
        <translation>无法查询%1所在磁盘的剩余空间。</translation>
    </message>
    <message>
        <source>The disk has %1 MB of room left. Make room for at least 100 MB.</source>
        <translation>磁盘仅剩%1 MB空间。请至少腾出100 MB。</translation>
    </message>
    <message>
        <source>Nothing can be written into the study&apos;s folder. See whether the disk is full or locked.</source>
        <translation>无法写入研究文件夹。请检查磁盘是否已满或被锁定。</translation>
    </message>
    <message>
        <source>A write took %1 ms, so an answer would wait. End other work on this disk, or use a faster one.</source>
        <translation>一次写入用了%1 ms，回答也得等这么久。请结束这个磁盘上的其他任务，或换用更快的磁盘。</translation>
    </message>
    <message>
        <source>The computer&apos;s clock is behind the last entry of the study. Set the clock.</source>
        <translation>计算机时钟早于研究的最后一条记录。请校准时钟。</translation>
    </message>
    <message>
        <source>This computer has no clock that runs evenly, so response times cannot be measured.</source>
        <translation>这台计算机没有匀速运行的时钟，无法测量反应时间。</translation>
    </message>
    <message>
        <source>Welcome the participant</source>
        <translation>迎接参与者</translation>
    </message>
    <message>
        <source>The participant does not wear the mask yet.</source>
        <translation>参与者此时还没有戴眼罩。</translation>
    </message>
    <message>
        <source>Give the participant the information sheet and time to read it.</source>
        <translation>把知情说明书交给参与者，并留出阅读时间。</translation>
    </message>
    <message>
        <source>Explain the session: the participant strokes the glass and pieces of fabric and says how they feel. There are breaks.</source>
        <translation>说明实验过程：参与者用手指滑过触觉屏和布料，并说出手感。中间有休息。</translation>
    </message>
    <message>
        <source>Say: “%1”</source>
        <translation>请说：“%1”</translation>
    </message>
    <message>
        <source>Begin (Enter)</source>
        <translation>开始 (Enter)</translation>
    </message>
    <message>
        <source>Consent</source>
        <translation>知情同意</translation>
    </message>
    <message>
        <source>You confirm: %1.</source>
        <translation>请您确认：%1。</translation>
    </message>
    <message>
        <source>If the participant does not agree, do not begin. Press W instead.</source>
        <translation>如果参与者不同意，就不要开始，改按W。</translation>
    </message>
    <message>
        <source>The participant has agreed (Enter)</source>
        <translation>参与者已同意 (Enter)</translation>
    </message>
    <message>
        <source>The participant may lift the mask, drink and move the hand.</source>
        <translation>参与者可以摘下眼罩、喝水、活动手部。</translation>
    </message>
    <message>
        <source>Clean the glass and the participant&apos;s finger. Let both dry.</source>
        <translation>擦净触觉屏和参与者的手指，等两者晾干。</translation>
    </message>
    <message>
        <source>Make sure that the participant wears the mask again before you continue.</source>
        <translation>继续之前，请确认参与者已重新戴好眼罩。</translation>
    </message>
    <message>
        <source>Break</source>
        <translation>休息</translation>
    </message>
    <message>
        <source>Break: new questions follow</source>
        <translation>休息：接下来是新的问题</translation>
    </message>
    <message>
        <source>Break: time for a rest</source>
        <translation>休息：该歇一会儿了</translation>
    </message>
    <message>
        <source>This sitting has lasted %1 minutes</source>
        <translation>本场次已进行%1分钟</translation>
    </message>
    <message>
        <source>The head of the log cannot be read now.</source>
        <translation>现在无法读取日志摘要。</translation>
    </message>
    <message>
        <source>Write down the head of the log: %1</source>
        <translation>请抄下日志摘要：%1</translation>
    </message>
    <message>
        <source>%1 of %2 answers are stored. The display is off.</source>
        <translation>已保存%1个回答，共%2个。触觉屏已关闭。</translation>
    </message>
    <message>
        <source>Questions that follow: %1. Explain them before the participant puts the mask on.</source>
        <translation>接下来的问题：%1。请在参与者戴上眼罩之前说明这些问题。</translation>
    </message>
    <message>
        <source>A tired hand feels less. Press Q to stop here and continue on another day. Everything is stored.</source>
        <translation>手累了，触觉会变迟钝。按Q可在此停止，改天继续。所有内容均已保存。</translation>
    </message>
    <message>
        <source>Continue (Enter)</source>
        <translation>继续 (Enter)</translation>
    </message>
    <message>
        <source>Continue anyway (Enter)</source>
        <translation>仍要继续 (Enter)</translation>
    </message>
    <message>
        <source>Stop here for today (Q)</source>
        <translation>今天到此为止 (Q)</translation>
    </message>
    <message>
        <source>Paused</source>
        <translation>已暂停</translation>
    </message>
    <message>
        <source>All answers so far are stored. The display is off.</source>
        <translation>到目前为止的回答均已保存。触觉屏已关闭。</translation>
    </message>
    <message>
        <source>An interrupted presentation starts again with the tray.</source>
        <translation>被打断的呈现将从摆放托盘重新开始。</translation>
    </message>
    <message>
        <source>You may close the window now. The session continues here later.</source>
        <translation>现在可以关闭窗口。以后实验会从这里继续。</translation>
    </message>
    <message>
        <source>Continue the session (Enter)</source>
        <translation>继续实验 (Enter)</translation>
    </message>
    <message>
        <source>Welcome back</source>
        <translation>欢迎回来</translation>
    </message>
    <message>
        <source>A new sitting begins. %1 of %2 answers are stored. %3</source>
        <translation>新的场次开始了。已保存%1个回答，共%2个。%3</translation>
    </message>
    <message>
        <source>First repeat the scale and the checklist.</source>
        <translation>请先重复量表练习和检查清单。</translation>
    </message>
    <message>
        <source>First repeat the scale.</source>
        <translation>请先重复量表练习。</translation>
    </message>
    <message>
        <source>First repeat the checklist.</source>
        <translation>请先重复检查清单。</translation>
    </message>
    <message>
        <source>After a short interruption you may skip this if everything is still in place.</source>
        <translation>如果只是短暂中断，而且一切都还在原位，可以跳过这一步。</translation>
    </message>
    <message>
        <source>Prepare this sitting (Enter)</source>
        <translation>准备本场次 (Enter)</translation>
    </message>
    <message>
        <source>Skip the preparation (G)</source>
        <translation>跳过准备 (G)</translation>
    </message>
    <message>
        <source>The session is complete</source>
        <translation>实验已完成</translation>
    </message>
    <message>
        <source>All %1 answers are stored. Thank the participant for the time and care.</source>
        <translation>全部%1个回答均已保存。请感谢参与者付出的时间和认真。</translation>
    </message>
    <message>
        <source>Clean the glass and put the fabrics back in order.</source>
        <translation>擦净触觉屏，把布样放回原处。</translation>
    </message>
    <message>
        <source>Back to the study (Enter)</source>
        <translation>返回研究 (Enter)</translation>
    </message>
    <message>
        <source>The participant has withdrawn</source>
        <translation>参与者已退出</translation>
    </message>
    <message>
        <source>The session has ended. Stored answers: %1. The study&apos;s owner gives this place out again.</source>
        <translation>实验已结束。已保存的回答：%1。这个名额由研究的所有者重新分配。</translation>
    </message>
    <message>
        <source>The session has ended. Stored answers: %1. Another participant can take this place.</source>
        <translation>实验已结束。已保存的回答：%1。这个名额可以由另一位参与者使用。</translation>
    </message>
    <message>
        <source>Thank the participant for coming.</source>
        <translation>请感谢参与者的到来。</translation>
    </message>
    <message>
        <source>“%1.” (%2)</source>
        <translation>“%1。”（%2）</translation>
    </message>
    <message>
        <source>Same</source>
        <translation>相同</translation>
    </message>
    <message>
        <source>Different</source>
        <translation>不同</translation>
    </message>
    <message>
        <source>“%1.”</source>
        <translation>“%1。”</translation>
    </message>
    <message>
        <source>Piece %1</source>
        <translation>布样%1</translation>
    </message>
    <message>
        <source>The two entries differ: “%1” and “%2”. Ask the participant again, then enter the answer twice.</source>
        <translation>两次录入不一致：“%1”和“%2”。请再问一次参与者，然后重新录入两遍。</translation>
    </message>
    <message>
        <source>Confirm the tray, store the answer, go on</source>
        <translation>确认托盘、保存回答、继续</translation>
    </message>
    <message>
        <source>Stamp the first touch</source>
        <translation>记录首次触摸</translation>
    </message>
    <message>
        <source>The answer begins (the spoken word)</source>
        <translation>回答开始（开口说话）</translation>
    </message>
    <message>
        <source>Correct a stored answer</source>
        <translation>更正已保存的回答</translation>
    </message>
    <message>
        <source>Write a note</source>
        <translation>写备注</translation>
    </message>
    <message>
        <source>Flag the presentation</source>
        <translation>标记呈现</translation>
    </message>
    <message>
        <source>Void the presentation</source>
        <translation>作废呈现</translation>
    </message>
    <message>
        <source>Pause</source>
        <translation>暂停</translation>
    </message>
    <message>
        <source>Stop for now</source>
        <translation>改日继续</translation>
    </message>
    <message>
        <source>Withdrawal of the participant</source>
        <translation>参与者退出</translation>
    </message>
    <message>
        <source>Enter</source>
        <translation>Enter</translation>
    </message>
    <message>
        <source>Page Down</source>
        <translation>Page Down</translation>
    </message>
    <message>
        <source>Page Up</source>
        <translation>Page Up</translation>
    </message>
    <message>
        <source>%1 is the standard key of “%2”. Press another key.</source>
        <translation>%1是“%2”的标准按键。请按其他键。</translation>
    </message>
    <message>
        <source>%1 acts as “%2” already. Press another key, or remove it there first.</source>
        <translation>%1已用于“%2”。请按其他键，或先在那里移除它。</translation>
    </message>
    <message>
        <source>This key moves or edits in a field. Press another key, such as F13 or Page Down.</source>
        <translation>这个键在输入框里用于移动或编辑。请按其他键，例如F13或Page Down。</translation>
    </message>
    <message>
        <source>This key writes a character, and characters are answers. Set the pedal to another key, such as F13.</source>
        <translation>这个键会输入字符，而字符就是回答。请把踏板设为其他键，例如F13。</translation>
    </message>
    <message>
        <source>Esc</source>
        <translation>Esc</translation>
    </message>
    <message>
        <source>%1 or %2</source>
        <translation>%1或%2</translation>
    </message>
    <message>
        <source>%1 (%2)</source>
        <translation>%1 (%2)</translation>
    </message>
    <message>
        <source>welcome</source>
        <translation>迎接</translation>
    </message>
    <message>
        <source>consent</source>
        <translation>知情同意</translation>
    </message>
    <message>
        <source>facts</source>
        <translation>基本信息</translation>
    </message>
    <message>
        <source>familiarisation</source>
        <translation>熟悉触觉屏</translation>
    </message>
    <message>
        <source>scale</source>
        <translation>量表</translation>
    </message>
    <message>
        <source>checklist</source>
        <translation>检查清单</translation>
    </message>
    <message>
        <source>tray</source>
        <translation>托盘</translation>
    </message>
    <message>
        <source>question %1</source>
        <translation>问题%1</translation>
    </message>
    <message>
        <source>break</source>
        <translation>休息</translation>
    </message>
    <message>
        <source>debriefing</source>
        <translation>实验后访谈</translation>
    </message>
    <message>
        <source>finished</source>
        <translation>已完成</translation>
    </message>
    <message>
        <source>withdrawn</source>
        <translation>已退出</translation>
    </message>
    <message>
        <source>withdrawn, waits for the owner</source>
        <translation>已退出，等待所有者处理</translation>
    </message>
    <message>
        <source>paused (%1)</source>
        <translation>已暂停（%1）</translation>
    </message>
    <message>
        <source>erased</source>
        <translation>已删除</translation>
    </message>
    <message>
        <source>Type the number that the participant says.</source>
        <translation>请输入参与者说出的数字。</translation>
    </message>
    <message>
        <source>“%1” is not a rating. Type a number with at most one decimal, such as 5.4.</source>
        <translation>“%1”不是有效的评分。请输入最多一位小数的数字，例如5.4。</translation>
    </message>
    <message>
        <source>%1 is outside the scale. Ratings go from %2 to %3. Ask the participant again.</source>
        <translation>%1超出量表范围。评分范围是%2至%3。请再问一次参与者。</translation>
    </message>
    <message>
        <source>%1 is between two steps of the scale. Ratings go in steps of %2. Ask the participant again.</source>
        <translation>%1落在量表的两个刻度之间。评分以%2为步长。请再问一次参与者。</translation>
    </message>
    <message>
        <source>from %1 to %2, one decimal</source>
        <translation>%1至%2，一位小数</translation>
    </message>
    <message>
        <source>from %1 to %2, whole numbers</source>
        <translation>%1至%2，整数</translation>
    </message>
    <message>
        <source>from %1 to %2 in steps of %3</source>
        <translation>%1至%2，步长%3</translation>
    </message>
    <message>
        <source>take off %1</source>
        <translation>取下%1</translation>
    </message>
    <message>
        <source>put %1 on the tray</source>
        <translation>把%1放上托盘</translation>
    </message>
    <message>
        <source>put %1 on %2</source>
        <translation>把%1放在%2格</translation>
    </message>
    <message>
        <source>move %1 from %2 to %3</source>
        <translation>把%1从%2格移到%3格</translation>
    </message>
    <message>
        <source>All pieces stay on the tray.</source>
        <translation>所有布样都留在托盘上。</translation>
    </message>
    <message>
        <source>en</source>
        <comment>language of new protocols</comment>
        <extracomment>The BCP 47 tag of your language, such as &quot;de&quot;: new protocols take their texts for participants from it.</extracomment>
        <translation>zh</translation>
    </message>
    <message>
        <source>, </source>
        <comment>between the names of a list</comment>
        <translation>、</translation>
    </message>
    <message>
        <source>%1 %2</source>
        <comment>two sentences</comment>
        <translation>%1%2</translation>
    </message>
    <message>
        <source>; </source>
        <comment>between the parts of a message</comment>
        <translation>；</translation>
    </message>
    <message>
        <source>This computer has no font for the language of the participants, %1: they would see boxes. Run: apt-get install %2</source>
        <translation>这台计算机没有参与者语言%1的字体：参与者会看到方框。请运行：apt-get install %2</translation>
    </message>
    <message>
        <source>free</source>
        <translation>空闲</translation>
    </message>
    <message>
        <source>in progress</source>
        <translation>进行中</translation>
    </message>
    <message>
        <source>%1 is no longer in the study&apos;s folder, so no answer can be stored. Close the study, then run vis2hap rescue on its folder: closing keeps every stored answer in a rescue file.</source>
        <translation>研究文件夹中已没有%1，因此无法保存任何回答。请关闭研究，然后对该文件夹运行vis2hap rescue：关闭时，已保存的所有回答都会写入一个救援文件。</translation>
    </message>
</context>
<context>
    <name>study::app::Below</name>
    <message>
        <source>The time stamp of the event is outside every session.</source>
        <translation>该事件的时间戳超出了任何实验的范围。</translation>
    </message>
    <message>
        <source>The participant has named enough places.</source>
        <translation>参与者已经说出了足够多的位置。</translation>
    </message>
    <message>
        <source>There is no such fabric for getting to know the display.</source>
        <translation>熟悉触觉屏时没有这种织物。</translation>
    </message>
    <message>
        <source>This is not the place on the line that is shown.</source>
        <translation>这不是线上所示的位置。</translation>
    </message>
    <message>
        <source>The time of the first touch is stored already.</source>
        <translation>首次触摸的时间已经保存。</translation>
    </message>
    <message>
        <source>This sitting is prepared already.</source>
        <translation>本场次已经准备好。</translation>
    </message>
    <message>
        <source>There has been no presentation yet.</source>
        <translation>还没有任何呈现。</translation>
    </message>
    <message>
        <source>The presentation before this one is void already.</source>
        <translation>前一次呈现已经作废。</translation>
    </message>
    <message>
        <source>The session is over. There is nothing to pause.</source>
        <translation>实验已经结束，无需暂停。</translation>
    </message>
    <message>
        <source>The session is not paused.</source>
        <translation>实验没有暂停。</translation>
    </message>
    <message>
        <source>The participant has withdrawn already.</source>
        <translation>参与者已经退出。</translation>
    </message>
    <message>
        <source>The participant has withdrawn. Answers cannot be changed.</source>
        <translation>参与者已退出，回答不能再更改。</translation>
    </message>
    <message>
        <source>The session is finished. Answers can be corrected until the debriefing is stored.</source>
        <translation>实验已结束。在保存实验后访谈之前，回答可以更正。</translation>
    </message>
    <message>
        <source>There is no answer to %1 yet.</source>
        <translation>%1还没有回答。</translation>
    </message>
    <message>
        <source>The note is empty.</source>
        <translation>备注是空的。</translation>
    </message>
    <message>
        <source>There is no presentation to flag yet.</source>
        <translation>还没有可标记的呈现。</translation>
    </message>
    <message>
        <source>The session is paused. Resume it first.</source>
        <translation>实验已暂停。请先继续实验。</translation>
    </message>
    <message>
        <source>The participant&apos;s list is empty.</source>
        <translation>这位参与者的清单是空的。</translation>
    </message>
    <message>
        <source>The text holds a character that nobody sees and that is not stored as it is. Type the text again.</source>
        <translation>文本含有一个看不见、且无法原样保存的字符。请重新输入文本。</translation>
    </message>
    <message>
        <source>The text is longer than 100,000 bytes, so it is not stored. Shorten it.</source>
        <translation>文本超过100,000字节，因此没有保存。请缩短文本。</translation>
    </message>
    <message>
        <source>The entry is too long, so it is not stored. Shorten its texts.</source>
        <translation>该条记录过长，因此没有保存。请缩短其中的文本。</translation>
    </message>
    <message>
        <source>The last step was only just taken, so this key confirmed nothing. Put the pieces on the tray, then confirm it.</source>
        <translation>上一步刚刚完成，所以这次按键没有确认任何内容。请先把布样放上托盘，再确认。</translation>
    </message>
    <message>
        <source>The last step was only just taken, so this key confirmed nothing. Press it again.</source>
        <translation>上一步刚刚完成，所以这次按键没有确认任何内容。请再按一次。</translation>
    </message>
    <message>
        <source>The piece in slot %1 is not confirmed. It must be %2.</source>
        <translation>%1格的布样尚未确认，应为%2。</translation>
    </message>
    <message>
        <source>Slot %1 holds %2. It must be %3.</source>
        <translation>%1格里是%2，应为%3。</translation>
    </message>
    <message>
        <source>More pieces were confirmed than the tray has slots.</source>
        <translation>确认的布样多于托盘的格数。</translation>
    </message>
    <message>
        <source>The session is finished.</source>
        <translation>实验已完成。</translation>
    </message>
    <message>
        <source>The participant has withdrawn.</source>
        <translation>参与者已退出。</translation>
    </message>
    <message>
        <source>No question is being asked now.</source>
        <translation>现在没有提出问题。</translation>
    </message>
    <message>
        <source>There is no presentation to void yet.</source>
        <translation>还没有可作废的呈现。</translation>
    </message>
    <message>
        <source>&quot;%1&quot; is not possible now (%2).</source>
        <translation>现在不能执行“%1”（%2）。</translation>
    </message>
    <message>
        <source>%1 is not on the tray (%2).</source>
        <translation>%1不在托盘上（%2）。</translation>
    </message>
    <message>
        <source>%1 is not on the scale: from %2 to %3 in steps of %4.</source>
        <translation>%1不在量表上：范围是%2至%3，步长%4。</translation>
    </message>
    <message>
        <source>%1 asks for %2, not for %3.</source>
        <translation>%1的回答应为%2，而不是%3。</translation>
    </message>
    <message>
        <source>one of the fabrics on the tray</source>
        <translation>托盘上的一种织物</translation>
    </message>
    <message>
        <source>a number on the scale</source>
        <translation>量表上的一个数字</translation>
    </message>
    <message>
        <source>same or different</source>
        <translation>相同或不同</translation>
    </message>
    <message>
        <source>words</source>
        <translation>文字</translation>
    </message>
    <message>
        <source>same</source>
        <translation>相同</translation>
    </message>
    <message>
        <source>different</source>
        <translation>不同</translation>
    </message>
    <message>
        <source>none</source>
        <translation>无</translation>
    </message>
    <message>
        <source>uniform</source>
        <translation>均匀</translation>
    </message>
    <message>
        <source>edge</source>
        <translation>边缘</translation>
    </message>
    <message>
        <source>grating %1 mm</source>
        <translation>光栅%1 mm</translation>
    </message>
    <message>
        <source>left–right ramp</source>
        <translation>从左到右渐变</translation>
    </message>
    <message>
        <source>the image cannot be written into the display&apos;s folder (%1)</source>
        <translation>无法把图像写入触觉屏的文件夹（%1）</translation>
    </message>
    <message>
        <source>a writable folder</source>
        <translation>可写的文件夹</translation>
    </message>
    <message>
        <source>free space or correct the permissions, then show the image again</source>
        <translation>请腾出空间或更正权限，然后再次显示图像</translation>
    </message>
    <message>
        <source>unknown display &apos;%1&apos;</source>
        <translation>未知的触觉屏“%1”</translation>
    </message>
    <message>
        <source>correct the name of the display</source>
        <translation>请更正触觉屏的名称</translation>
    </message>
    <message>
        <source>there is no output for sound</source>
        <translation>没有声音输出设备</translation>
    </message>
    <message>
        <source>headphones or loudspeakers, 48 kHz stereo</source>
        <translation>耳机或扬声器，48 kHz立体声</translation>
    </message>
    <message>
        <source>connect the headphones, then start the sound again</source>
        <translation>请连接耳机，然后重新启动声音</translation>
    </message>
    <message>
        <source>the output for sound cannot be opened</source>
        <translation>无法打开声音输出设备</translation>
    </message>
    <message>
        <source>a free output</source>
        <translation>空闲的输出设备</translation>
    </message>
    <message>
        <source>close other programs that play sound, then start it again</source>
        <translation>请关闭其他播放声音的程序，然后重新启动声音</translation>
    </message>
    <message>
        <source>the output for sound has stopped</source>
        <translation>声音输出设备已停止</translation>
    </message>
    <message>
        <source>the output for sound is no longer connected</source>
        <translation>声音输出设备已断开</translation>
    </message>
    <message>
        <source>covering the only screen would hide the console</source>
        <translation>覆盖唯一的屏幕会遮住本窗口</translation>
    </message>
    <message>
        <source>there is no screen %1 to cover</source>
        <translation>没有可供覆盖的屏幕%1</translation>
    </message>
    <message>
        <source>a screen other than the console&apos;s (screens of this computer: %1, numbered from 0)</source>
        <translation>本窗口所在屏幕之外的屏幕（这台计算机的屏幕：%1，从0起编号）</translation>
    </message>
    <message>
        <source>connect the screen of the display, or leave &quot;cover&quot; out and stamp touches with the key T</source>
        <translation>请连接触觉屏的屏幕；或者去掉“cover”，用T键记录触摸</translation>
    </message>
    <message>
        <source>the screen of the display was disconnected</source>
        <translation>触觉屏的屏幕已断开</translation>
    </message>
    <message>
        <source>a connected screen during the whole session</source>
        <translation>整个实验期间保持连接的屏幕</translation>
    </message>
    <message>
        <source>connect the screen, press Q to stop, and open the session again</source>
        <translation>请连接屏幕，按Q停止，再重新打开实验</translation>
    </message>
    <message>
        <source>the display refuses: %1</source>
        <translation>触觉屏拒绝了请求：%1</translation>
    </message>
    <message>
        <source>this display takes tickets only</source>
        <translation>此触觉屏只接受服务器的凭票</translation>
    </message>
    <message>
        <source>while an image was felt, the display&apos;s driver %1</source>
        <translation>参与者正在触摸图像时，触觉屏的驱动程序%1</translation>
    </message>
    <message>
        <source>the display&apos;s driver %1</source>
        <translation>触觉屏的驱动程序%1</translation>
    </message>
    <message>
        <source>the device&apos;s driver %1</source>
        <translation>设备的驱动程序%1</translation>
    </message>
    <message>
        <source>%1 (tried %2 times)</source>
        <translation>%1（已尝试%2次）</translation>
    </message>
    <message>
        <source>does not start: %1</source>
        <translation>没有启动：%1</translation>
    </message>
    <message>
        <source>does not answer &quot;%1&quot; within %2</source>
        <translation>没有在%2内回应“%1”</translation>
    </message>
    <message>
        <source>it sent instead: %1</source>
        <translation>它发来的是：%1</translation>
    </message>
    <message>
        <source>its error text: %1</source>
        <translation>它的错误信息：%1</translation>
    </message>
    <message>
        <source>cannot be started (%1)</source>
        <translation>无法启动（%1）</translation>
    </message>
    <message>
        <source>cannot be reached (%1)</source>
        <translation>无法访问（%1）</translation>
    </message>
    <message>
        <source>was stopped before it answered</source>
        <translation>在回应之前被停止</translation>
    </message>
    <message>
        <source>sends more than was requested</source>
        <translation>发来的内容多于请求的内容</translation>
    </message>
    <message>
        <source>closed its standard output</source>
        <translation>关闭了标准输出</translation>
    </message>
    <message>
        <source>closed the connection</source>
        <translation>关闭了连接</translation>
    </message>
    <message>
        <source>was closed</source>
        <translation>已被关闭</translation>
    </message>
    <message>
        <source>uses &quot;%1&quot;, but this program uses %2</source>
        <translation>使用“%1”，而本程序使用%2</translation>
    </message>
    <message>
        <source>this is no study folder (it has no study.db)</source>
        <translation>这不是研究文件夹（其中没有study.db）</translation>
    </message>
    <message>
        <source>a folder made by vis2hap study new</source>
        <translation>由vis2hap study new创建的文件夹</translation>
    </message>
    <message>
        <source>check the path</source>
        <translation>请检查路径</translation>
    </message>
    <message>
        <source>this is no SQLite database</source>
        <translation>这不是SQLite数据库</translation>
    </message>
    <message>
        <source>the study.db of a study folder</source>
        <translation>研究文件夹中的study.db</translation>
    </message>
    <message>
        <source>the study has its own %1, but no %2</source>
        <translation>研究有自己的%1，但没有%2</translation>
    </message>
    <message>
        <source>write them, too, so that every text describes the same ends of the scale</source>
        <translation>请一并写上，使所有文字描述的量表两端一致</translation>
    </message>
    <message>
        <source>another program has the study open for writing (process %1)</source>
        <translation>另一个程序正在写入这项研究（进程%1）</translation>
    </message>
    <message>
        <source>another program has the study open for writing</source>
        <translation>另一个程序正在写入这项研究</translation>
    </message>
    <message>
        <source>one writer at a time</source>
        <translation>同一时间只有一个写入程序</translation>
    </message>
    <message>
        <source>close the study there first</source>
        <translation>请先在那里关闭研究</translation>
    </message>
    <message>
        <source>the lock of the study was deleted or replaced while it was open</source>
        <translation>研究打开期间，其锁文件被删除或替换</translation>
    </message>
    <message>
        <source>close the study in every program, then open it again</source>
        <translation>请在所有程序中关闭该研究，然后重新打开</translation>
    </message>
    <message>
        <source>every stored answer is in it</source>
        <translation>所有已保存的回答都在其中</translation>
    </message>
    <message>
        <source>another computer has the study open for writing, or its program ended without closing it (process %1)</source>
        <translation>另一台计算机已打开此研究并可写入，或者其程序未关闭研究就已结束（进程%1）</translation>
    </message>
    <message>
        <source>one computer at a time on a disk that other computers may use</source>
        <translation>网络共享上同一时间只有一台计算机</translation>
    </message>
    <message>
        <source>close the study there</source>
        <translation>请在那里关闭研究</translation>
    </message>
    <message>
        <source>where it is closed for certain, delete %1 and do it again</source>
        <translation>如果确定那里已关闭，请删除%1，然后重试</translation>
    </message>
    <message>
        <source>the file system does not say whether the database is in its place (%1)</source>
        <translation>文件系统没有说明数据库是否仍在原处（%1）</translation>
    </message>
    <message>
        <source>a disk or a network share that answers</source>
        <translation>能够响应的磁盘或网络共享</translation>
    </message>
    <message>
        <source>check it and do the step again</source>
        <translation>请检查后重做这一步</translation>
    </message>
    <message>
        <source>the study cannot be opened for writing: %1</source>
        <translation>无法以写入方式打开研究：%1</translation>
    </message>
    <message>
        <source>a folder that may be written</source>
        <translation>可写的文件夹</translation>
    </message>
    <message>
        <source>check its permissions and its file system</source>
        <translation>请检查它的权限和文件系统</translation>
    </message>
    <message>
        <source>the folder holds a study already</source>
        <translation>该文件夹里已有一项研究</translation>
    </message>
    <message>
        <source>a new folder</source>
        <translation>新的文件夹</translation>
    </message>
    <message>
        <source>choose another name</source>
        <translation>请换一个名称</translation>
    </message>
    <message>
        <source>a newer version of this program made the study (schema %1)</source>
        <translation>研究由本程序的较新版本创建（结构版本%1）</translation>
    </message>
    <message>
        <source>schema %1 or older</source>
        <translation>结构版本%1或更早</translation>
    </message>
    <message>
        <source>update this program</source>
        <translation>请更新本程序</translation>
    </message>
    <message>
        <source>the database of the study was deleted, replaced, overwritten or moved while it was open</source>
        <translation>研究打开期间，其数据库被删除、替换、覆盖或移动</translation>
    </message>
    <message>
        <source>the file that the session began with</source>
        <translation>实验开始时所用的文件</translation>
    </message>
    <message>
        <source>every stored answer is kept in %1</source>
        <translation>每个已保存的回答都保留在%1中</translation>
    </message>
    <message>
        <source>close the study, then run vis2hap rescue %1</source>
        <translation>请关闭研究，然后运行vis2hap rescue %1</translation>
    </message>
    <message>
        <source>the protocol was changed after the study was made</source>
        <translation>实验方案在研究创建之后被更改</translation>
    </message>
    <message>
        <source>the protocol cannot be read</source>
        <translation>无法读取实验方案</translation>
    </message>
    <message>
        <source>the text in the database</source>
        <translation>数据库中的文本</translation>
    </message>
    <message>
        <source>accept the change with `%1`, or restore the text with `%2`</source>
        <translation>用`%1`接受更改，或用`%2`恢复文本</translation>
    </message>
    <message>
        <source>run vis2hap verify on the study</source>
        <translation>请对这项研究运行vis2hap verify</translation>
    </message>
    <message>
        <source>restore it from a backup</source>
        <translation>请从备份恢复</translation>
    </message>
    <message>
        <source>the file from the making of the study</source>
        <translation>创建研究时的文件</translation>
    </message>
    <message>
        <source>vis2hap verify lists all faults</source>
        <translation>vis2hap verify会列出所有错误</translation>
    </message>
    <message>
        <source>there is no such folder</source>
        <translation>没有这个文件夹</translation>
    </message>
    <message>
        <source>a folder that exists</source>
        <translation>已存在的文件夹</translation>
    </message>
    <message>
        <source>choose another folder</source>
        <translation>请选择其他文件夹</translation>
    </message>
    <message>
        <source>nothing was written</source>
        <translation>没有写入任何内容</translation>
    </message>
    <message>
        <source>the files would lie in the study</source>
        <translation>这些文件会落在研究文件夹里</translation>
    </message>
    <message>
        <source>a folder outside %1</source>
        <translation>%1之外的文件夹</translation>
    </message>
    <message>
        <source>Open the pages in a browser and print them.</source>
        <translation>请在浏览器中打开这些页面并打印。</translation>
    </message>
    <message>
        <source>%1 of %2 answers (%3) came within %4 s of the touch</source>
        <translation>%2个回答中有%1个（%3）在触摸后%4 s内给出</translation>
    </message>
    <message>
        <source>%1: %2 of %3 ratings are %4</source>
        <translation>%1：%3个评分中有%2个是%4</translation>
    </message>
    <message>
        <source>a participant who feels no difference also gives such ratings</source>
        <translation>感觉不到差别的参与者也会给出这样的评分</translation>
    </message>
    <message>
        <source>%1 of %2 presentations got the same number for every question</source>
        <translation>%2次呈现中有%1次对所有问题给出同一个数字</translation>
    </message>
    <message>
        <source>%1: %2 was chosen in %3 of %4 trials (p %5)</source>
        <translation>%1：%4次呈现中有%3次选择了%2（p %5）</translation>
    </message>
    <message>
        <source>tray slot %1</source>
        <translation>托盘的%1格</translation>
    </message>
    <message>
        <source>the answer &quot;%1&quot;</source>
        <translation>回答“%1”</translation>
    </message>
    <message>
        <source>%1: %2 was given in all %3 trials</source>
        <translation>%1：全部%3次呈现中的回答都是%2</translation>
    </message>
    <message>
        <source>%1 ratings of %2 have at least the mean of the renderings&apos; ratings</source>
        <translation>对%2的%1个评分，其均值不低于对渲染的评分均值</translation>
    </message>
    <message>
        <source>blank glass (catch trials)</source>
        <translation>空白屏面（捕捉试次）</translation>
    </message>
    <message>
        <source>mismatched presentations (another fabric)</source>
        <translation>用另一种织物的不匹配呈现</translation>
    </message>
    <message>
        <source>mismatch_rated_high</source>
        <translation>不匹配呈现评分过高</translation>
    </message>
    <message>
        <source>too_fast</source>
        <translation>回答过快</translation>
    </message>
    <message>
        <source>straight_lining</source>
        <translation>总是同一个数字</translation>
    </message>
    <message>
        <source>same_across_questions</source>
        <translation>各问题评分相同</translation>
    </message>
    <message>
        <source>slot_bias</source>
        <translation>偏好某一格</translation>
    </message>
    <message>
        <source>blank_glass_rated_high</source>
        <translation>空白屏面评分过高</translation>
    </message>
    <message>
        <source>reading the protocol, drawing samples</source>
        <translation>读取实验方案，抽取样本</translation>
    </message>
    <message>
        <source>the hash of the data set</source>
        <translation>数据集的哈希值</translation>
    </message>
    <message>
        <source>signals and friction images</source>
        <translation>信号和摩擦图像</translation>
    </message>
    <message>
        <source>comparison of signals</source>
        <translation>信号比较</translation>
    </message>
    <message>
        <source>images for familiarisation</source>
        <translation>熟悉阶段的图像</translation>
    </message>
    <message>
        <source>photographs written</source>
        <translation>已写入的照片</translation>
    </message>
    <message>
        <source>%1 is unusual for cloth (one drawn cloth in twenty is like it)</source>
        <translation>%1对织物来说不常见（二十种绘制织物中约有一种如此）</translation>
    </message>
    <message>
        <source>its height and friction are doubtful</source>
        <translation>其高度和摩擦不可靠</translation>
    </message>
    <message>
        <source>the scale is unknown</source>
        <translation>比例未知</translation>
    </message>
    <message>
        <source>%1 per pixel is assumed, as if its threads were those of ordinary clothing</source>
        <translation>假定每像素%1，即认为其纱线与普通衣料相同</translation>
    </message>
    <message>
        <source>its weave repeats every %1, finer than cloth is (%2)</source>
        <translation>其组织每%1重复一次，比真实织物更细（%2）</translation>
    </message>
    <message>
        <source>check the scale</source>
        <translation>请检查比例</translation>
    </message>
    <message>
        <source>the data set has too few fabrics for the paper&apos;s questions</source>
        <translation>数据集的织物太少，不够用于论文中的问题</translation>
    </message>
    <message>
        <source>%1 or more</source>
        <translation>%1或更多</translation>
    </message>
    <message>
        <source>%1 fabrics</source>
        <translation>%1种织物</translation>
    </message>
    <message>
        <source>add photographs, or make a new study with a protocol of your own</source>
        <translation>请添加照片，或用您自己的实验方案新建研究</translation>
    </message>
    <message>
        <source>photograph %1 of %2</source>
        <translation>第%1张照片，共%2张</translation>
    </message>
    <message>
        <source>running orders</source>
        <translation>呈现顺序</translation>
    </message>
    <message>
        <source>sealing and writing</source>
        <translation>密封并写入</translation>
    </message>
    <message>
        <source>the station key cannot be read</source>
        <translation>无法读取工作站密钥</translation>
    </message>
    <message>
        <source>the station key is not the one committed in the database</source>
        <translation>工作站密钥与数据库中登记的不符</translation>
    </message>
    <message>
        <source>is empty</source>
        <translation>为空</translation>
    </message>
    <message>
        <source>has %1 bytes</source>
        <translation>有%1字节</translation>
    </message>
    <message>
        <source>is not UTF-8</source>
        <translation>不是UTF-8编码</translation>
    </message>
    <message>
        <source>begins with a dot</source>
        <translation>以点开头</translation>
    </message>
    <message>
        <source>begins with a dash</source>
        <translation>以连字符开头</translation>
    </message>
    <message>
        <source>begins with a blank</source>
        <translation>以空格开头</translation>
    </message>
    <message>
        <source>ends with a blank</source>
        <translation>以空格结尾</translation>
    </message>
    <message>
        <source>holds a control character</source>
        <translation>含有控制字符</translation>
    </message>
    <message>
        <source>holds an invisible character</source>
        <translation>含有不可见字符</translation>
    </message>
    <message>
        <source>holds a slash or backslash</source>
        <translation>含有斜杠或反斜杠</translation>
    </message>
    <message>
        <source>holds a comma</source>
        <translation>含有逗号</translation>
    </message>
    <message>
        <source>stands for a missing value in tables</source>
        <translation>在表格中表示缺失值</translation>
    </message>
    <message>
        <source>%1 to %2 bytes of UTF-8 without control or invisible characters, slashes, backslashes and commas, that begin with no dot, dash or blank and end with no blank</source>
        <translation>%1至%2字节的UTF-8文本，不含控制字符、不可见字符、斜杠、反斜杠和逗号，不以点、连字符或空格开头，也不以空格结尾</translation>
    </message>
    <message>
        <source>%1 does not look like cloth</source>
        <translation>%1看起来不像织物</translation>
    </message>
    <message>
        <source>what is generated from it means nothing</source>
        <translation>由它生成的内容没有意义</translation>
    </message>
    <message>
        <source>photograph %1 of %2 is unusual for cloth (one drawn cloth in twenty is like it)</source>
        <translation>第%1张照片（共%2张）对织物来说不常见（二十种绘制织物中约有一种如此）</translation>
    </message>
    <message>
        <source>expected %1</source>
        <translation>应为%1</translation>
    </message>
    <message>
        <source>signals of the same places</source>
        <translation>信号取自相同位置</translation>
    </message>
    <message>
        <source>signals of different places</source>
        <translation>信号取自不同位置</translation>
    </message>
    <message>
        <source>procedural, signals of the same places</source>
        <translation>程序生成，信号取自相同位置</translation>
    </message>
    <message>
        <source>procedural, signals of different places</source>
        <translation>程序生成，信号取自不同位置</translation>
    </message>
    <message>
        <source>photographs %1 mm per pixel</source>
        <translation>照片每像素%1 mm</translation>
    </message>
    <message>
        <source>frames %1 mm per pixel</source>
        <translation>触觉图像每像素%1 mm</translation>
    </message>
    <message>
        <source>photographs of unknown scale</source>
        <translation>照片比例未知</translation>
    </message>
    <message>
        <source>frames of unknown scale</source>
        <translation>触觉图像比例未知</translation>
    </message>
    <message>
        <source>strokes at %1 mm/s and %2 Hz</source>
        <translation>滑动速度%1 mm/s，采样率%2 Hz</translation>
    </message>
    <message>
        <source>is empty, expected a name for the study</source>
        <translation>为空，应为研究的名称</translation>
    </message>
    <message>
        <source>%1, expected at least %2</source>
        <translation>%1，应至少为%2</translation>
    </message>
    <message>
        <source>%1 are named, expected %2</source>
        <translation>列出了%1个，应为%2个</translation>
    </message>
    <message>
        <source>is empty, expected the id of a fabric</source>
        <translation>为空，应为织物的标识</translation>
    </message>
    <message>
        <source>&apos;%1&apos; is named twice, expected each fabric once</source>
        <translation>“%1”出现两次，每种织物应只出现一次</translation>
    </message>
    <message>
        <source>is empty, expected at least one of %1</source>
        <translation>为空，应至少为%1之一</translation>
    </message>
    <message>
        <source>is empty, expected the folder of the images</source>
        <translation>为空，应为图像文件夹</translation>
    </message>
    <message>
        <source>&apos;%1&apos; is named twice, expected each condition once</source>
        <translation>“%1”出现两次，每个条件应只出现一次</translation>
    </message>
    <message>
        <source>%1, expected at most the number of presentations in the phase</source>
        <translation>%1，不应超过本阶段的呈现数</translation>
    </message>
    <message>
        <source>%1 questions with a right answer, expected one (and any number in free_text)</source>
        <translation>有正确答案的问题有%1个，应为一个（free_text中的问题数量不限）</translation>
    </message>
    <message>
        <source>is empty, expected at least one question</source>
        <translation>为空，应至少有一个问题</translation>
    </message>
    <message>
        <source>&apos;%1&apos; is asked twice, expected each question once</source>
        <translation>“%1”问了两次，每个问题应只问一次</translation>
    </message>
    <message>
        <source>&apos;%1&apos; has no text, expected one in question_texts</source>
        <translation>“%1”没有句子，应写在question_texts中</translation>
    </message>
    <message>
        <source>is empty, expected a name such as &quot;speed&quot;</source>
        <translation>为空，应为名称，例如“speed”</translation>
    </message>
    <message>
        <source>&apos;%1&apos; is named twice, expected ids that differ also when their case is ignored</source>
        <translation>“%1”出现两次，标识不应仅有大小写之别</translation>
    </message>
    <message>
        <source>expected 0.1 to 3600 seconds</source>
        <translation>应为0.1至3600秒</translation>
    </message>
    <message>
        <source>is empty, expected the sentence that the operator says</source>
        <translation>为空，应为主试所说的句子</translation>
    </message>
    <message>
        <source>is empty, expected at least one phase</source>
        <translation>为空，应至少有一个阶段</translation>
    </message>
    <message>
        <source>&apos;%1&apos; and &apos;%2&apos; are not a planned contrast in this order, expected a pair of planned</source>
        <translation>“%1”和“%2”按此顺序不是计划对比，应为planned中的一对</translation>
    </message>
    <message>
        <source>is empty, expected the id of a condition</source>
        <translation>为空，应为条件的标识</translation>
    </message>
    <message>
        <source>&apos;%1&apos; is not among the conditions, expected a pair of the protocol&apos;s conditions</source>
        <translation>“%1”不在条件之中，应为实验方案中的一对条件</translation>
    </message>
    <message>
        <source>compares &apos;%1&apos; with itself, expected two conditions</source>
        <translation>将“%1”与自身比较，应为两个条件</translation>
    </message>
    <message>
        <source>repeats an earlier contrast, expected each pair once</source>
        <translation>重复了前面的对比，每一对应只出现一次</translation>
    </message>
    <message>
        <source>the lower is not below the upper, expected [lower, upper]</source>
        <translation>下限不低于上限，应为[下限, 上限]</translation>
    </message>
    <message>
        <source>expected more than 0</source>
        <translation>应大于0</translation>
    </message>
    <message>
        <source>expected at least 1 presentation</source>
        <translation>应至少为1次呈现</translation>
    </message>
    <message>
        <source>expected at least 1 minute</source>
        <translation>应至少为1分钟</translation>
    </message>
    <message>
        <source>expected 0 to 5 seconds</source>
        <translation>应为0至5秒</translation>
    </message>
    <message>
        <source>expected 0 or more</source>
        <translation>应为0或更大</translation>
    </message>
    <message>
        <source>&apos;%1&apos; is missing</source>
        <translation>缺少“%1”</translation>
    </message>
    <message>
        <source>unknown key &apos;%1&apos;</source>
        <translation>未知的键“%1”</translation>
    </message>
    <message>
        <source>%1, expected %2</source>
        <translation>%1，应为%2</translation>
    </message>
    <message>
        <source>&apos;%1&apos; is a column of exported answers, expected another id</source>
        <translation>“%1”是导出回答中的列名，应换用其他标识</translation>
    </message>
    <message>
        <source>the tray has one piece, expected a phase with alternatives</source>
        <translation>托盘上只有一块布样，应为带alternatives的阶段</translation>
    </message>
    <message>
        <source>&apos;%1&apos; is not among the phase&apos;s questions</source>
        <translation>“%1”不在本阶段的问题之中</translation>
    </message>
    <message>
        <source>&apos;%1&apos; is asked in no phase, expected ids of the phases&apos; questions</source>
        <translation>没有阶段问到“%1”，应为各阶段问题的标识</translation>
    </message>
    <message>
        <source>%1, expected a whole number of tenths</source>
        <translation>%1，应为0.1的整数倍</translation>
    </message>
    <message>
        <source>%1, expected at most 26, for the slots A to Z</source>
        <translation>%1，应至多为26（A格至Z格）</translation>
    </message>
    <message>
        <source>%1 of %2 fabrics, expected no more alternatives than fabrics</source>
        <translation>%2种织物中的%1种，选项不应多于织物</translation>
    </message>
    <message>
        <source>max is not above min, expected min &lt; max</source>
        <translation>最大值不大于最小值，应为min &lt; max</translation>
    </message>
    <message>
        <source>is not positive, expected at least 0.1</source>
        <translation>不是正数，应至少为0.1</translation>
    </message>
    <message>
        <source>does not lead from min to max, expected a whole number of steps</source>
        <translation>不能从最小值到达最大值，应为整数个步长</translation>
    </message>
    <message>
        <source>%1 words, expected %2</source>
        <translation>%1个词，应为%2个</translation>
    </message>
    <message>
        <source>one fabric, expected at least 2, so that some can differ</source>
        <translation>只有一种织物，应至少有2种，才会有不同的织物</translation>
    </message>
    <message>
        <source>presentations of a rendering per participant</source>
        <translation>每位参与者对每个渲染的呈现次数</translation>
    </message>
    <message>
        <source>ordered pairs of conditions</source>
        <translation>条件的有序对</translation>
    </message>
    <message>
        <source>ordered pairs of fabrics</source>
        <translation>织物的有序对</translation>
    </message>
    <message>
        <source>a condition per stretch of the order</source>
        <translation>每段呈现顺序中的同一条件</translation>
    </message>
    <message>
        <source>a fabric per stretch of the order</source>
        <translation>每段呈现顺序中的同一织物</translation>
    </message>
    <message>
        <source>foil sets per true fabric</source>
        <translation>每种正确织物的干扰样组合</translation>
    </message>
    <message>
        <source>true slots per participant and fabric</source>
        <translation>每位参与者和织物的正确格</translation>
    </message>
    <message>
        <source>true slots per condition</source>
        <translation>每个条件的正确格</translation>
    </message>
    <message>
        <source>a fabric as foil per participant</source>
        <translation>每位参与者中某织物作为干扰样</translation>
    </message>
    <message>
        <source>slots of a foil per participant</source>
        <translation>每位参与者中干扰样所在的格</translation>
    </message>
    <message>
        <source>The server has not given out this presentation yet.</source>
        <translation>服务器尚未发放本次呈现。</translation>
    </message>
    <message>
        <source>the server cannot be reached</source>
        <translation>无法连接服务器</translation>
    </message>
    <message>
        <source>the server cannot be reached: %1</source>
        <translation>无法连接服务器：%1</translation>
    </message>
    <message>
        <source>wait until it can be reached again, then go on</source>
        <translation>请等到服务器恢复后再继续</translation>
    </message>
    <message>
        <source>the connection to the server ended (%1)</source>
        <translation>与服务器的连接已中断（%1）</translation>
    </message>
    <message>
        <source>the server does not answer</source>
        <translation>服务器没有响应</translation>
    </message>
    <message>
        <source>check the network and the server</source>
        <translation>请检查网络和服务器</translation>
    </message>
    <message>
        <source>the server refused this login: %1</source>
        <translation>服务器拒绝了此登录：%1</translation>
    </message>
    <message>
        <source>the server refused user or password: %1</source>
        <translation>服务器拒绝了用户名或密码：%1</translation>
    </message>
    <message>
        <source>the server has too many connections: %1</source>
        <translation>服务器的连接过多：%1</translation>
    </message>
    <message>
        <source>the server stops: %1</source>
        <translation>服务器正在停止：%1</translation>
    </message>
    <message>
        <source>the server takes no connections now: %1</source>
        <translation>服务器目前不接受连接：%1</translation>
    </message>
    <message>
        <source>there is no password for this login: %1</source>
        <translation>此登录没有密码：%1</translation>
    </message>
    <message>
        <source>the server does not encrypt: %1</source>
        <translation>服务器不加密：%1</translation>
    </message>
    <message>
        <source>the certificate of the server is not accepted here: %1</source>
        <translation>此处不接受服务器的证书：%1</translation>
    </message>
    <message>
        <source>the certificate belongs to another server: %1</source>
        <translation>证书属于另一台服务器：%1</translation>
    </message>
    <message>
        <source>the certificate of the lab&apos;s authority cannot be read: %1</source>
        <translation>无法读取证书颁发机构的证书：%1</translation>
    </message>
    <message>
        <source>the key of this login cannot be used: %1</source>
        <translation>无法使用此登录的密钥：%1</translation>
    </message>
    <message>
        <source>the server wants a certificate of this login: %1</source>
        <translation>服务器要求此登录提供证书：%1</translation>
    </message>
    <message>
        <source>the server refused the encryption: %1</source>
        <translation>服务器拒绝了加密：%1</translation>
    </message>
    <message>
        <source>a certificate cannot be used: %1</source>
        <translation>无法使用某个证书：%1</translation>
    </message>
    <message>
        <source>the service is unknown: %1</source>
        <translation>未知的服务：%1</translation>
    </message>
    <message>
        <source>the service file cannot be read: %1</source>
        <translation>无法读取服务文件：%1</translation>
    </message>
    <message>
        <source>a setting of the address is wrong: %1</source>
        <translation>地址中的某项设置有误：%1</translation>
    </message>
    <message>
        <source>hosts and ports do not agree: %1</source>
        <translation>主机与端口不一致：%1</translation>
    </message>
    <message>
        <source>no server of the list takes entries: %1</source>
        <translation>列表中没有服务器接受条目：%1</translation>
    </message>
    <message>
        <source>all slots of the study are taken</source>
        <translation>研究的所有名额都已占用</translation>
    </message>
    <message>
        <source>The server refused answers of %1 that waited here (%2). They are kept in %3.</source>
        <translation>服务器拒绝了在此等待的 %1 的回答（%2）。它们保存在 %3 中。</translation>
    </message>
    <message>
        <source>the server takes nothing from this station now (%1)</source>
        <translation>服务器目前不接收本工作站的任何内容（%1）</translation>
    </message>
    <message>
        <source>remove the cause, then go on</source>
        <translation>请先排除原因，然后继续</translation>
    </message>
    <message>
        <source>the server lost entries of %1 (%2), so this session cannot go on</source>
        <translation>服务器缺少 %1 的记录（%2 条），因此本次实验无法继续</translation>
    </message>
    <message>
        <source>the server gained entries of %1 (%2), so this session cannot go on</source>
        <translation>服务器有 %1 的新记录（%2 条），因此本次实验无法继续</translation>
    </message>
    <message>
        <source>the server has other entries of %1, so this session cannot go on</source>
        <translation>服务器上 %1 的记录与本机不同，因此本次实验无法继续</translation>
    </message>
    <message>
        <source>the server refused entries of %1, so this session cannot go on</source>
        <translation>服务器拒绝了 %1 的记录，因此本次实验无法继续</translation>
    </message>
    <message>
        <source>the log that this station holds, kept in this file</source>
        <translation>本工作站持有的记录，已保存在此文件中</translation>
    </message>
    <message>
        <source>open the participant again</source>
        <translation>请重新打开该参与者</translation>
    </message>
    <message>
        <source>%1 was enrolled at another station in the meantime</source>
        <translation>%1 已在另一个工作站登记</translation>
    </message>
    <message>
        <source>participant %1 has withdrawn</source>
        <translation>参与者 %1 已退出</translation>
    </message>
    <message>
        <source>a code that nobody has</source>
        <translation>一个无人使用的代码</translation>
    </message>
    <message>
        <source>type the next free code, or choose the participant in the list</source>
        <translation>请输入下一个可用代码，或在列表中选择该参与者</translation>
    </message>
    <message>
        <source>type the next free code</source>
        <translation>请输入下一个可用代码</translation>
    </message>
    <message>
        <source>the server lost entries after entry %1, so codes of participants may be lost, too</source>
        <translation>服务器缺少第 %1 条之后的记录，因此参与者代码也可能丢失</translation>
    </message>
    <message>
        <source>ask the study&apos;s owner</source>
        <translation>请询问研究的所有者</translation>
    </message>
    <message>
        <source>if the owner agrees, enrol %1 once more</source>
        <translation>如果所有者同意，请再次登记 %1</translation>
    </message>
    <message>
        <source>the server has another study of this name than before</source>
        <translation>服务器上是另一项同名研究，与以前的不同</translation>
    </message>
    <message>
        <source>move this folder elsewhere to join the other study</source>
        <translation>若要加入另一项研究，请把此文件夹移到别处</translation>
    </message>
    <message>
        <source>%1 entries for another address wait in the folder of this station</source>
        <translation>本工作站的文件夹中有 %1 条发往另一个地址的记录在等待</translation>
    </message>
    <message>
        <source>signals of %1</source>
        <translation>%1的信号</translation>
    </message>
    <message>
        <source>generating</source>
        <translation>正在生成信号</translation>
    </message>
    <message>
        <source>composing</source>
        <translation>正在合成摩擦图像</translation>
    </message>
    <message>
        <source>generated against measured</source>
        <translation>正在将生成的信号与测量的信号比较</translation>
    </message>
    <message>
        <source>training photographs for retrieval</source>
        <translation>正在读取用于检索的训练照片</translation>
    </message>
    <message>
        <source>open the folder itself, so that they are sent</source>
        <translation>请直接打开该文件夹，以便发送这些记录</translation>
    </message>
    <message>
        <source>if its address is gone, move it elsewhere and give it to the study&apos;s owner</source>
        <translation>如果其地址已不存在，请把它移到别处并交给研究的所有者</translation>
    </message>
    <message>
        <source>give the file to the study&apos;s owner, then open the address again</source>
        <translation>请把该文件交给研究的所有者，然后重新打开该地址</translation>
    </message>
    <message>
        <source>the computer starts no further work</source>
        <translation>计算机无法再启动新的任务</translation>
    </message>
    <message>
        <source>memory and room for one more thread</source>
        <translation>供再启动一个线程的内存和余量</translation>
    </message>
    <message>
        <source>close other programs, then try again</source>
        <translation>请关闭其他程序，然后重试</translation>
    </message>
</context>
<context>
    <name>study::app::Catalogue</name>
    <message>
        <source>name of the language</source>
        <extracomment>The name of your language in your language, such as &quot;Deutsch&quot;.</extracomment>
        <translation>简体中文</translation>
    </message>
    <message>
        <source>reviewer</source>
        <extracomment>The native speaker who has checked the catalogue. Leave it empty until somebody has.</extracomment>
        <translation></translation>
    </message>
    <message>
        <source>version of the program</source>
        <extracomment>The version of the program that the catalogue is made for, such as &quot;0.6.0&quot;.</extracomment>
        <translation>0.6.0</translation>
    </message>
</context>
<context>
    <name>study::app::CheckPanel</name>
    <message>
        <source>“%1” has no sentence</source>
        <translation>“%1”没有句子</translation>
    </message>
    <message>
        <source>%1 questions have a right answer, expected one; others can be answered in own words</source>
        <translation>%1个问题有正确答案，应为一个；其他问题可以用自己的话回答</translation>
    </message>
    <message>
        <source>%1: %2</source>
        <translation>%1：%2</translation>
    </message>
    <message>
        <source>Line %1, column %2. %3</source>
        <translation>第%1行第%2列。%3</translation>
    </message>
    <message>
        <source>No fault</source>
        <translation>没有错误</translation>
    </message>
    <message>
        <source>1 fault</source>
        <translation>1个错误</translation>
    </message>
    <message>
        <source>%1 faults</source>
        <translation>%1个错误</translation>
    </message>
    <message>
        <source>Remove it</source>
        <translation>移除</translation>
    </message>
    <message>
        <source>Go to</source>
        <translation>前往</translation>
    </message>
    <message>
        <source>Remove it: %1</source>
        <translation>移除：%1</translation>
    </message>
    <message>
        <source>Go to: %1</source>
        <translation>前往：%1</translation>
    </message>
    <message>
        <source>… and %1 more</source>
        <translation>……以及另外%1个</translation>
    </message>
    <message>
        <source>No fault. Presentations: %1, minutes: %2, sittings: %3</source>
        <translation>没有错误。呈现：%1，分钟：%2，场次：%3</translation>
    </message>
    <message>
        <source>Minutes, power and the preview follow when there is no fault.</source>
        <translation>没有错误时才会显示时长、检验力和预览。</translation>
    </message>
    <message>
        <source>Each participant: about %1 minutes without breaks. Presentations: %2, answers: %3, breaks: %4, sittings: %5. The whole study: answers: %6.</source>
        <translation>每位参与者：不含休息约%1分钟。呈现：%2，回答：%3，休息：%4，场次：%5。整个研究：回答：%6。</translation>
    </message>
    <message>
        <source>Power and balance are being computed …</source>
        <translation>正在计算检验力和平衡性…</translation>
    </message>
    <message>
        <source>%1: a difference of %2 scale points between two conditions</source>
        <translation>%1：两个条件相差%2个量表分</translation>
    </message>
    <message>
        <source>%1: %2 % right answers in one condition</source>
        <translation>%1：一个条件下的正确率为%2%</translation>
    </message>
    <message>
        <source>With a power of 80 %, under the usual assumptions, the study detects:</source>
        <translation>在通常的假设下，以80%的检验力，本研究可以检出：</translation>
    </message>
    <message>
        <source>%1: %2 to %3</source>
        <translation>%1：%2至%3</translation>
    </message>
    <message>
        <source>Balance of the running orders:</source>
        <translation>呈现顺序的平衡性：</translation>
    </message>
    <message>
        <source>Orders of this length take long to draw; `vis2hap protocol show` prints their balance.</source>
        <translation>生成这么长的顺序需要很久；`vis2hap protocol show`会打印其平衡性。</translation>
    </message>
    <message>
        <source>%1, %2</source>
        <translation>%1，%2</translation>
    </message>
    <message>
        <source>%1 is missing</source>
        <translation>缺少“%1”</translation>
    </message>
    <message>
        <source>%1: none yet</source>
        <translation>%1：尚未选择</translation>
    </message>
</context>
<context>
    <name>study::app::ChecklistPage</name>
    <message>
        <source>Everything is ready (Enter)</source>
        <translation>全部就绪 (Enter)</translation>
    </message>
    <message>
        <source>Before the first presentation</source>
        <translation>第一次呈现之前</translation>
    </message>
    <message>
        <source>Work through the list. Press Space to tick a line. The program stores the time when you finish.</source>
        <translation>逐项检查清单。按空格键勾选一项。完成时，程序会保存时间。</translation>
    </message>
    <message>
        <source>This display takes its images from the server only, so it plays no test patterns.</source>
        <translation>此触觉屏只接受服务器的图像，因此不播放测试图案。</translation>
    </message>
    <message>
        <source>Feel the test pattern:</source>
        <translation>触摸测试图案：</translation>
    </message>
    <message>
        <source>Feel the test pattern. Gratings need the width of a pixel from the display page.</source>
        <translation>请触摸测试图案。光栅需要“触觉屏”页面上的像素宽度。</translation>
    </message>
    <message>
        <source>This line is not ticked yet: %1. Check it, then press Space.</source>
        <translation>这一项尚未勾选：%1。请检查，然后按空格键。</translation>
    </message>
    <message>
        <source>Nothing is written for “%1”. Press Enter again to go on without it.</source>
        <translation>“%1”还没有填写。再按一次Enter，可不填写直接继续。</translation>
    </message>
    <message>
        <source>“%1” is not a number. Press Enter again to store it.</source>
        <translation>“%1”不是数字。再按一次Enter即可保存。</translation>
    </message>
</context>
<context>
    <name>study::app::ChoiceControls</name>
    <message>
        <source>Answers to choose by letter</source>
        <translation>按字母选择的回答</translation>
    </message>
    <message>
        <source>No answer is chosen. Press the letter that the participant says.</source>
        <translation>尚未选择回答。请按参与者说出的字母。</translation>
    </message>
    <message>
        <source>Press the letter that the participant says.</source>
        <translation>请按参与者说出的字母。</translation>
    </message>
    <message>
        <source>Read back: %1</source>
        <translation>请复述：%1</translation>
    </message>
</context>
<context>
    <name>study::app::ConditionsSection</name>
    <message>
        <source>The brightness of the photograph is felt as relief.</source>
        <translation>照片的亮度被感受为起伏。</translation>
    </message>
    <message>
        <source>Relief that is computed from the shading of the photograph.</source>
        <translation>由照片明暗计算出的起伏。</translation>
    </message>
    <message>
        <source>Friction along the stroke, generated from the photograph.</source>
        <translation>由照片生成的沿滑动方向的摩擦。</translation>
    </message>
    <message>
        <source>Relief that is generated from the photograph.</source>
        <translation>由照片生成的起伏。</translation>
    </message>
    <message>
        <source>Relief and mean friction, both generated from the photograph.</source>
        <translation>起伏和平均摩擦，均由照片生成。</translation>
    </message>
    <message>
        <source>The brightness of a tactile sensor&apos;s picture is felt as relief.</source>
        <translation>触觉传感器图像的亮度被感受为起伏。</translation>
    </message>
    <message>
        <source>Friction that was measured along a stroke.</source>
        <translation>沿滑动方向测得的摩擦。</translation>
    </message>
    <message>
        <source>Relief that was measured with a tactile sensor.</source>
        <translation>用触觉传感器测得的起伏。</translation>
    </message>
    <message>
        <source>Relief and mean friction, both measured.</source>
        <translation>起伏和平均摩擦，均为测得。</translation>
    </message>
    <message>
        <source>Slope of the measured relief along the stroke; not in the paper.</source>
        <translation>测得起伏沿滑动方向的斜率；论文中没有。</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>移除</translation>
    </message>
    <message>
        <source>Name of your condition</source>
        <translation>您的条件的名称</translation>
    </message>
    <message>
        <source>Folder of its images</source>
        <translation>其图像的文件夹</translation>
    </message>
    <message>
        <source>Add your images</source>
        <translation>添加您的图像</translation>
    </message>
    <message>
        <source>Add your program</source>
        <translation>添加您的程序</translation>
    </message>
    <message>
        <source>Browse…</source>
        <translation>浏览…</translation>
    </message>
    <message>
        <source>Condition at another quality</source>
        <translation>另一质量等级的条件</translation>
    </message>
    <message>
        <source>Quality</source>
        <translation>质量</translation>
    </message>
    <message>
        <source>Add this quality</source>
        <translation>添加这一质量等级</translation>
    </message>
    <message>
        <source>Conditions</source>
        <translation>条件</translation>
    </message>
    <message>
        <source>Ways to turn a fabric into what the finger feels on the screen.</source>
        <translation>把织物变成手指在屏幕上所感受的内容的各种方式。</translation>
    </message>
    <message>
        <source>Condition %1: %2</source>
        <translation>条件%1：%2</translation>
    </message>
    <message>
        <source>Your own conditions</source>
        <translation>您自己的条件</translation>
    </message>
    <message>
        <source>A folder with one ready friction image a fabric: F01.png, F02.png, … Or a program, which you name when you make the study with `vis2hap study new --program`. They are blinded and balanced like all others.</source>
        <translation>一个文件夹，每种织物一张现成的摩擦图像：F01.png、F02.png……或者一个程序，在用`vis2hap study new --program`创建研究时指定。它们与其他条件一样接受盲法处理并保持平衡。</translation>
    </message>
    <message>
        <source>Further conditions of the study</source>
        <translation>研究的其他条件</translation>
    </message>
    <message>
        <source>mine</source>
        <translation>mine</translation>
    </message>
    <message>
        <source>the folder with the images</source>
        <translation>图像所在的文件夹</translation>
    </message>
    <message>
        <source>One condition at several qualities</source>
        <translation>同一条件的多个质量等级</translation>
    </message>
    <message>
        <source>Quality trades computing time for exactness, so a study can compare its prices.</source>
        <translation>质量等级用计算时间换取精确度，因此研究可以比较其代价。</translation>
    </message>
    <message>
        <source>%1    by a program</source>
        <translation>%1    由程序生成</translation>
    </message>
    <message>
        <source>%1    from %2</source>
        <translation>%1    来自%2</translation>
    </message>
    <message>
        <source>Folder of the images</source>
        <translation>图像文件夹</translation>
    </message>
    <message>
        <source>Your condition has no name. Type one, such as mine.</source>
        <translation>您的条件没有名称。请输入一个，例如mine。</translation>
    </message>
    <message>
        <source>No folder is given. Choose the folder that holds one image a fabric.</source>
        <translation>没有给出文件夹。请选择每种织物各有一张图像的文件夹。</translation>
    </message>
</context>
<context>
    <name>study::app::ConnectingPage</name>
    <message>
        <source>Stop (Esc)</source>
        <translation>停止 (Esc)</translation>
    </message>
    <message>
        <source>Connecting the display…</source>
        <translation>正在连接触觉屏…</translation>
    </message>
    <message>
        <source>%1 has up to 10 seconds to answer.</source>
        <translation>%1最多有10秒时间回应。</translation>
    </message>
</context>
<context>
    <name>study::app::CorrectionPanel</name>
    <message>
        <source>Question</source>
        <translation>问题</translation>
    </message>
    <message>
        <source>Stored answer</source>
        <translation>已保存的回答</translation>
    </message>
    <message>
        <source>New answer</source>
        <translation>新回答</translation>
    </message>
    <message>
        <source>Correct an answer</source>
        <translation>更正回答</translation>
    </message>
    <message>
        <source>The study keeps the old answer beside the new one.</source>
        <translation>研究会把旧回答与新回答一并保留。</translation>
    </message>
    <message>
        <source>Reason</source>
        <translation>原因</translation>
    </message>
    <message>
        <source>Store the correction (Enter)</source>
        <translation>保存更正 (Enter)</translation>
    </message>
    <message>
        <source>Write a short reason, such as “misheard”. Press Enter again to store the correction without a reason.</source>
        <translation>请简要写明原因，例如“听错了”。再按一次Enter，可不写原因直接保存更正。</translation>
    </message>
    <message>
        <source>%1 is the stored answer. Choose another answer, or press Esc to go back.</source>
        <translation>%1是已保存的回答。请选择另一个回答，或按Esc返回。</translation>
    </message>
    <message>
        <source>Correct the answer to %1</source>
        <translation>更正对%1的回答</translation>
    </message>
</context>
<context>
    <name>study::app::DataPage</name>
    <message>
        <source>Folder of the data set</source>
        <translation>数据集文件夹</translation>
    </message>
    <message>
        <source>Browse…</source>
        <translation>浏览…</translation>
    </message>
    <message>
        <source>Open the data set (Enter)</source>
        <translation>打开数据集 (Enter)</translation>
    </message>
    <message>
        <source>Previous (Page Up)</source>
        <translation>上一个 (Page Up)</translation>
    </message>
    <message>
        <source>Next (Page Down)</source>
        <translation>下一个 (Page Down)</translation>
    </message>
    <message>
        <source>Back (Esc)</source>
        <translation>返回 (Esc)</translation>
    </message>
    <message>
        <source>Fabrics of the data set</source>
        <translation>数据集中的织物</translation>
    </message>
    <message>
        <source>Fabric</source>
        <translation>织物</translation>
    </message>
    <message>
        <source>Name</source>
        <translation>名称</translation>
    </message>
    <message>
        <source>Photographs</source>
        <translation>照片</translation>
    </message>
    <message>
        <source>Frames</source>
        <translation>触觉图像</translation>
    </message>
    <message>
        <source>Heights</source>
        <translation>高度图</translation>
    </message>
    <message>
        <source>Strokes</source>
        <translation>滑动</translation>
    </message>
    <message>
        <source>Faults</source>
        <translation>错误</translation>
    </message>
    <message>
        <source>Faults found in the files</source>
        <translation>文件中发现的错误</translation>
    </message>
    <message>
        <source>Choose a fabric: arrow keys in the list   ·   scroll the page: Ctrl ↑ and Ctrl ↓</source>
        <translation>选择织物：在列表中用方向键   ·   滚动页面：Ctrl ↑和Ctrl ↓</translation>
    </message>
    <message>
        <source>Look at a data set</source>
        <translation>查看数据集</translation>
    </message>
    <message>
        <source>Check the data before the first participant comes. This page shows bad presses and clipped images.</source>
        <translation>请在第一位参与者到来之前检查数据。本页可显示失败的按压和过曝的图像。</translation>
    </message>
    <message>
        <source>the folder that contains dataset.json</source>
        <translation>含有dataset.json的文件夹</translation>
    </message>
    <message>
        <source>Fabric data set</source>
        <translation>织物数据集</translation>
    </message>
    <message>
        <source>No folder is given. Type the folder of the data set, or choose it with Browse.</source>
        <translation>没有给出文件夹。请输入数据集文件夹，或用“浏览”选择。</translation>
    </message>
    <message>
        <source>The program reads the data set.</source>
        <translation>程序正在读取数据集。</translation>
    </message>
    <message>
        <source>%1: %2</source>
        <translation>%1：%2</translation>
    </message>
    <message>
        <source>%1 (%2)</source>
        <translation>%1（%2）</translation>
    </message>
    <message>
        <source>The program checks every file.</source>
        <translation>程序正在检查每个文件。</translation>
    </message>
    <message>
        <source>The program checks every file: %1 % done.</source>
        <translation>程序正在检查每个文件：已完成%1%。</translation>
    </message>
    <message>
        <source>All files are valid.</source>
        <translation>所有文件均有效。</translation>
    </message>
    <message>
        <source>Faults found in the files: %1</source>
        <translation>文件中发现的错误：%1</translation>
    </message>
    <message>
        <source>%1: no samples</source>
        <translation>%1：没有样本</translation>
    </message>
    <message>
        <source>%1, sample %2 of %3</source>
        <translation>%1，第%2个样本，共%3个</translation>
    </message>
</context>
<context>
    <name>study::app::DebriefingPage</name>
    <message>
        <source>Comments of the participant about the session</source>
        <translation>参与者对实验的意见</translation>
    </message>
    <message>
        <source>After the last presentation</source>
        <translation>最后一次呈现之后</translation>
    </message>
    <message>
        <source>The display is off. The participant may take off the mask now.</source>
        <translation>触觉屏已关闭。参与者现在可以摘下眼罩。</translation>
    </message>
    <message>
        <source>You may leave the field empty. The text is stored apart from the answers and can be erased later. Press Shift and Enter for a new line.</source>
        <translation>此栏可以留空。文本与回答分开保存，以后可以删除。按Shift和Enter换行。</translation>
    </message>
    <message>
        <source>Finish the session (Enter)</source>
        <translation>完成实验 (Enter)</translation>
    </message>
    <message>
        <source>Ask: “%1”</source>
        <translation>请问：“%1”</translation>
    </message>
    <message>
        <source>Ask: “%1” Then explain the purpose of the study.</source>
        <translation>请问：“%1”随后请说明研究目的。</translation>
    </message>
</context>
<context>
    <name>study::app::DisplayChoice</name>
    <message>
        <source>The display of the last time, %1, is not connected: an operator could open its plain images. Choose another display here, or start the program with --plain-images.</source>
        <translation>上次使用的触觉屏%1没有连接：主试可能会打开其未加密的图像。请在这里选择其他触觉屏，或用--plain-images启动程序。</translation>
    </message>
    <message>
        <source>Connecting the display was stopped.</source>
        <translation>已停止连接触觉屏。</translation>
    </message>
</context>
<context>
    <name>study::app::DisplayPage</name>
    <message>
        <source>No display</source>
        <translation>无触觉屏</translation>
    </message>
    <message>
        <source>Driver program</source>
        <translation>驱动程序</translation>
    </message>
    <message>
        <source>Command that starts the driver</source>
        <translation>启动驱动程序的命令</translation>
    </message>
    <message>
        <source>/opt/display/driver --port 3</source>
        <translation>/opt/display/driver --port 3</translation>
    </message>
    <message>
        <source>Driver on another computer</source>
        <translation>另一台计算机上的驱动程序</translation>
    </message>
    <message>
        <source>Host and port of the driver</source>
        <translation>驱动程序的主机和端口</translation>
    </message>
    <message>
        <source>192.168.1.20:7000</source>
        <translation>192.168.1.20:7000</translation>
    </message>
    <message>
        <source>Cover of a touch screen, without a device</source>
        <translation>覆盖触摸屏，不接设备</translation>
    </message>
    <message>
        <source>Number of the screen, from 0</source>
        <translation>屏幕编号，从0起</translation>
    </message>
    <message>
        <source>1</source>
        <translation>1</translation>
    </message>
    <message>
        <source>Folder with plain images</source>
        <translation>存放未加密图像的文件夹</translation>
    </message>
    <message>
        <source>Folder that the device watches</source>
        <translation>设备监视的文件夹</translation>
    </message>
    <message>
        <source>/run/display</source>
        <translation>/run/display</translation>
    </message>
    <message>
        <source>Address of the display</source>
        <translation>触觉屏的地址</translation>
    </message>
    <message>
        <source>Connect (Enter)</source>
        <translation>连接 (Enter)</translation>
    </message>
    <message>
        <source>Rehearse without a display</source>
        <translation>不用触觉屏预演</translation>
    </message>
    <message>
        <source>Back (Esc)</source>
        <translation>返回 (Esc)</translation>
    </message>
    <message>
        <source>Width of one pixel, mm</source>
        <translation>像素宽度，mm</translation>
    </message>
    <message>
        <source>Kind of display</source>
        <translation>触觉屏的类型</translation>
    </message>
    <message>
        <source>Kinds of displays</source>
        <translation>触觉屏的各种类型</translation>
    </message>
    <message>
        <source>not measured</source>
        <translation>未测量</translation>
    </message>
    <message>
        <source>Display</source>
        <translation>触觉屏</translation>
    </message>
    <message>
        <source>Connect the haptic display and feel a test pattern before the participant comes.</source>
        <translation>请在参与者到来之前连接触觉屏，并触摸测试图案。</translation>
    </message>
    <message>
        <source>Test patterns</source>
        <translation>测试图案</translation>
    </message>
    <message>
        <source>Width of one pixel in mm. Gratings need it: divide the width of the active area by its number of pixels.</source>
        <translation>一个像素的宽度，单位mm。光栅需要它：用有效区域的宽度除以像素数。</translation>
    </message>
    <message>
        <source>Connecting was stopped. The display is not connected.</source>
        <translation>连接已停止。触觉屏未连接。</translation>
    </message>
    <message>
        <source>Stop (Esc)</source>
        <translation>停止 (Esc)</translation>
    </message>
    <message>
        <source>Connecting… The driver has up to 10 seconds to answer.</source>
        <translation>正在连接… 驱动程序最多有10秒时间回应。</translation>
    </message>
    <message>
        <source>The display is connected. This window uses it from now on, and at the next start.</source>
        <translation>触觉屏已连接。本窗口从现在起以及下次启动时都使用它。</translation>
    </message>
    <message>
        <source>Nothing can be felt without a display. A session with a participant needs one.</source>
        <translation>没有触觉屏就什么也摸不到。有参与者的实验必须有触觉屏。</translation>
    </message>
    <message>
        <source>Connected: %1</source>
        <translation>已连接：%1</translation>
    </message>
    <message>
        <source>Not connected</source>
        <translation>未连接</translation>
    </message>
    <message>
        <source>%1 × %2 px</source>
        <translation>%1 × %2 px</translation>
    </message>
    <message>
        <source>sessions send %1 × %2 px: test the driver with `vis2hap display check`</source>
        <translation>实验发送%1 × %2 px的图像：请用`vis2hap display check`检查驱动程序</translation>
    </message>
    <message>
        <source>reports touches (%1 so far)</source>
        <translation>会报告触摸（目前%1次）</translation>
    </message>
    <message>
        <source>takes its images from the server only: no test patterns</source>
        <translation>只接受服务器的图像：没有测试图案</translation>
    </message>
    <message>
        <source>does not report touches: press T at the first touch</source>
        <translation>不报告触摸：首次触摸时请按T</translation>
    </message>
    <message>
        <source>On: %1</source>
        <translation>开：%1</translation>
    </message>
    <message>
        <source>Off: nothing can be felt</source>
        <translation>关：摸不到任何内容</translation>
    </message>
</context>
<context>
    <name>study::app::EditorPage</name>
    <message>
        <source>Save (Ctrl S)</source>
        <translation>保存 (Ctrl S)</translation>
    </message>
    <message>
        <source>Save as…</source>
        <translation>另存为…</translation>
    </message>
    <message>
        <source>Make the study…</source>
        <translation>创建研究…</translation>
    </message>
    <message>
        <source>Undo (Ctrl Z)</source>
        <translation>撤销 (Ctrl Z)</translation>
    </message>
    <message>
        <source>Back (Esc)</source>
        <translation>返回 (Esc)</translation>
    </message>
    <message>
        <source>This protocol belongs to a study that exists; `vis2hap study amend` changes it there. Here you edit a copy for a new study.</source>
        <translation>这个实验方案属于一项已有的研究；在那里请用`vis2hap study amend`更改。您在这里编辑的是供新研究使用的副本。</translation>
    </message>
    <message>
        <source>The file has faults: %1. Each is shown with line and column.</source>
        <translation>文件有错误：%1个。每个错误都标明行和列。</translation>
    </message>
    <message>
        <source>Save the protocol</source>
        <translation>保存实验方案</translation>
    </message>
    <message>
        <source>Protocols (*.json)</source>
        <translation>实验方案 (*.json)</translation>
    </message>
    <message>
        <source>This folder belongs to a study that exists. Save the protocol elsewhere; `vis2hap study amend` changes the protocol of that study.</source>
        <translation>这个文件夹属于一项已有的研究。请把实验方案保存到别处；要更改那项研究的方案，请用`vis2hap study amend`。</translation>
    </message>
    <message>
        <source>Saved: %1</source>
        <translation>已保存：%1</translation>
    </message>
    <message>
        <source>Copy its recordings there, too: %1</source>
        <translation>请把它的录音也复制到那里：%1</translation>
    </message>
    <message>
        <source>A study cannot follow this protocol yet. Mend the faults first: %1</source>
        <translation>研究还不能采用这个实验方案。请先改正错误：%1</translation>
    </message>
    <message>
        <source>This page does not show that field. It is kept as it is in the file.</source>
        <translation>本页不显示这个字段，它在文件中保持原样。</translation>
    </message>
    <message>
        <source>This page cannot remove that key. Nothing was changed. Remove it in a text editor.</source>
        <translation>本页无法删除这个键，没有作任何更改。请用文本编辑器删除它。</translation>
    </message>
    <message>
        <source>New protocol</source>
        <translation>新实验方案</translation>
    </message>
    <message>
        <source>%1 (not saved)</source>
        <translation>%1（未保存）</translation>
    </message>
    <message>
        <source>Back to the fields (F6)</source>
        <translation>返回字段 (F6)</translation>
    </message>
    <message>
        <source>%1. Details (F6)</source>
        <translation>%1。详细信息 (F6)</translation>
    </message>
</context>
<context>
    <name>study::app::EditorSections</name>
    <message>
        <source>empty: “%1”</source>
        <translation>留空：“%1”</translation>
    </message>
    <message>
        <source>Course of a session</source>
        <translation>实验进程</translation>
    </message>
    <message>
        <source>Empty fields have usual values, which they show.</source>
        <translation>留空的字段采用所显示的常用值。</translation>
    </message>
    <message>
        <source>Seconds a presentation</source>
        <translation>每次呈现的秒数</translation>
    </message>
    <message>
        <source>Presentations before a break</source>
        <translation>休息前的呈现数</translation>
    </message>
    <message>
        <source>Minutes before a break</source>
        <translation>休息前的分钟数</translation>
    </message>
    <message>
        <source>no limit</source>
        <translation>不限</translation>
    </message>
    <message>
        <source>Minutes of a sitting</source>
        <translation>每个场次的分钟数</translation>
    </message>
    <message>
        <source>Fabrics and tray</source>
        <translation>织物与托盘</translation>
    </message>
    <message>
        <source>Fabrics to get used to</source>
        <translation>熟悉阶段的织物数</translation>
    </message>
    <message>
        <source>Seconds a new tray is locked</source>
        <translation>新托盘的锁定秒数</translation>
    </message>
    <message>
        <source>Codes on the fabric pieces</source>
        <translation>布样上的编码</translation>
    </message>
    <message>
        <source>one set for the whole study</source>
        <translation>整个研究用一套</translation>
    </message>
    <message>
        <source>new codes for each participant</source>
        <translation>每位参与者用新的编码</translation>
    </message>
    <message>
        <source>The operator scans or types the code of every piece</source>
        <translation>主试扫描或输入每块布样的编码</translation>
    </message>
    <message>
        <source>The operator enters every answer twice</source>
        <translation>主试把每个回答录入两次</translation>
    </message>
    <message>
        <source>Texts</source>
        <translation>文本</translation>
    </message>
    <message>
        <source>The operator reads them aloud or ticks them. Write them in the language of your participants.</source>
        <translation>由主试朗读或勾选。请用参与者的语言书写。</translation>
    </message>
    <message>
        <source>Language of the participants, as a tag</source>
        <translation>参与者的语言（语言标签）</translation>
    </message>
    <message>
        <source>en; others are de, pt-BR, zh-CN</source>
        <translation>en；其他如de、pt-BR、zh-CN</translation>
    </message>
    <message>
        <source>Consent, which the operator confirms</source>
        <translation>由主试确认的知情同意</translation>
    </message>
    <message>
        <source>How to stroke glass and fabric</source>
        <translation>怎样滑过屏幕和布料</translation>
    </message>
    <message>
        <source>Checklist before a sitting, one point a line</source>
        <translation>场次前的检查清单，每行一项</translation>
    </message>
    <message>
        <source>The participant wears the eye mask</source>
        <translation>参与者已戴好眼罩</translation>
    </message>
    <message>
        <source>Readings before a sitting, one quantity with its unit a line</source>
        <translation>场次前的读数，每行一个带单位的量</translation>
    </message>
    <message>
        <source>temperature in °C</source>
        <translation>温度（°C）</translation>
    </message>
    <message>
        <source>Facts that the participant may give, one a line</source>
        <translation>参与者可提供的基本信息，每行一项</translation>
    </message>
    <message>
        <source>age</source>
        <translation>年龄</translation>
    </message>
    <message>
        <source>Participant&apos;s screen</source>
        <translation>参与者屏幕</translation>
    </message>
    <message>
        <source>Choose a sentence and write your own. Names in braces, such as {time}, stay as they are.</source>
        <translation>选择一句话，写入您自己的句子。花括号中的名称（如 {time}）请保持不变。</translation>
    </message>
    <message>
        <source>Sentences by their names</source>
        <translation>句子及其名称</translation>
    </message>
    <message>
        <source>Your sentence; empty: the usual one</source>
        <translation>您的句子；留空则用默认句子</translation>
    </message>
    <message>
        <source>Recordings for the headphones</source>
        <translation>耳机录音</translation>
    </message>
    <message>
        <source>WAV files that lie beside the protocol. A computer voice says what has no recording.</source>
        <translation>与实验方案放在同一文件夹的 WAV 文件。没有录音的提示语由电脑语音朗读。</translation>
    </message>
    <message>
        <source>Prompts by their names</source>
        <translation>提示语及其名称</translation>
    </message>
    <message>
        <source>File of the recording; empty: none</source>
        <translation>录音文件；留空则没有</translation>
    </message>
</context>
<context>
    <name>study::app::EditorStart</name>
    <message>
        <source>Floor and ceiling of ratings</source>
        <translation>评分的下限与上限</translation>
    </message>
    <message>
        <source>Some images come with another fabric, some twice.</source>
        <translation>有些图像配以其他织物，有些出现两次。</translation>
    </message>
    <message>
        <source>Two pieces and five words</source>
        <translation>两块布样与五个词</translation>
    </message>
    <message>
        <source>One of two pieces, then how similar it is, in five words.</source>
        <translation>先从两块布样中选一块，再用五个词表示有多相似。</translation>
    </message>
    <message>
        <source>Same or different</source>
        <translation>相同或不同</translation>
    </message>
    <message>
        <source>Is the fabric the one on the screen? Blank glass finds guessers.</source>
        <translation>布料是不是屏幕上的那一种？空白屏面可以找出随意猜测的人。</translation>
    </message>
    <message>
        <source>Speed against accuracy</source>
        <translation>速度与准确</translation>
    </message>
    <message>
        <source>The same choices under “be fast”, “be accurate” and a deadline.</source>
        <translation>在“求快”“求准”和限时三种要求下作同样的选择。</translation>
    </message>
    <message>
        <source>Quality of the rendering</source>
        <translation>渲染质量</translation>
    </message>
    <message>
        <source>One rendering at three prices in computing time.</source>
        <translation>同一渲染，三种计算时间代价。</translation>
    </message>
    <message>
        <source>Your own images</source>
        <translation>您自己的图像</translation>
    </message>
    <message>
        <source>Friction images that you made, beside two renderings of the program.</source>
        <translation>您制作的摩擦图像，与本程序的两种渲染并列。</translation>
    </message>
    <message>
        <source>Your own program</source>
        <translation>您自己的程序</translation>
    </message>
    <message>
        <source>A program of yours makes the friction images, beside two renderings.</source>
        <translation>由您的程序生成摩擦图像，与两种渲染并列。</translation>
    </message>
    <message>
        <source>Exercise for a class</source>
        <translation>课堂练习</translation>
    </message>
    <message>
        <source>Simulated answers with planted effects and a careless participant.</source>
        <translation>带有预设效应和一位敷衍的参与者的模拟回答。</translation>
    </message>
    <message>
        <source>Pilot of one participant</source>
        <translation>一位参与者的预实验</translation>
    </message>
    <message>
        <source>Shows whether the set-up works and how long a presentation takes.</source>
        <translation>看装置是否可用，以及一次呈现要多长时间。</translation>
    </message>
    <message>
        <source>%1
%2</source>
        <translation>%1
%2</translation>
    </message>
    <message>
        <source>Begin with this (Enter)</source>
        <translation>由此开始 (Enter)</translation>
    </message>
    <message>
        <source>Protocol file</source>
        <translation>实验方案文件</translation>
    </message>
    <message>
        <source>Browse…</source>
        <translation>浏览…</translation>
    </message>
    <message>
        <source>Open the protocol</source>
        <translation>打开实验方案</translation>
    </message>
    <message>
        <source>Back (Esc)</source>
        <translation>返回 (Esc)</translation>
    </message>
    <message>
        <source>Make a protocol</source>
        <translation>制作实验方案</translation>
    </message>
    <message>
        <source>A protocol says who feels what, in which order, and what is asked. A study that exists keeps its own; `vis2hap study amend` changes that.</source>
        <translation>实验方案规定谁以什么顺序感受什么，以及问什么。已有的研究保留自己的方案；要更改它，请用`vis2hap study amend`。</translation>
    </message>
    <message>
        <source>Begin with</source>
        <translation>起点</translation>
    </message>
    <message>
        <source>a protocol file to change, .json</source>
        <translation>要更改的实验方案文件，.json</translation>
    </message>
    <message>
        <source>Change a protocol</source>
        <translation>更改实验方案</translation>
    </message>
    <message>
        <source>The study of the paper
10 participants, 7 fabrics, 9 conditions, a choice among three pieces and three ratings.</source>
        <translation>论文中的研究
10位参与者、7种织物、9种条件，一次三选一和三个评分。</translation>
    </message>
    <message>
        <source>Empty
Nothing is chosen yet.</source>
        <translation>空白
尚未选择任何内容。</translation>
    </message>
    <message>
        <source>Protocols (*.json)</source>
        <translation>实验方案 (*.json)</translation>
    </message>
    <message>
        <source>No file is given. Type a protocol file, or choose it with Browse.</source>
        <translation>没有给出文件。请输入实验方案文件，或用“浏览”选择。</translation>
    </message>
</context>
<context>
    <name>study::app::FactsPage</name>
    <message>
        <source>Continue (Enter)</source>
        <translation>继续 (Enter)</translation>
    </message>
    <message>
        <source>About the participant</source>
        <translation>参与者的基本信息</translation>
    </message>
    <message>
        <source>Ask the participant and write the answers down. You may leave any line empty.</source>
        <translation>请询问参与者并记下回答。任何一行都可以留空。</translation>
    </message>
    <message>
        <source>Say: “%1”</source>
        <translation>请说：“%1”</translation>
    </message>
</context>
<context>
    <name>study::app::FamiliarisationPage</name>
    <message>
        <source>The participant is ready (Enter)</source>
        <translation>参与者已准备好 (Enter)</translation>
    </message>
    <message>
        <source>Getting to know the display</source>
        <translation>熟悉触觉屏</translation>
    </message>
    <message>
        <source>Nothing is scored here. Seat the participant so that one hand reaches both the display and the tray.</source>
        <translation>这一步不计分。请安排好座位，使参与者的一只手能同时够到触觉屏和托盘。</translation>
    </message>
    <message>
        <source>Say: “%1”</source>
        <translation>请说：“%1”</translation>
    </message>
    <message>
        <source>Let the participant stroke some fabrics on the table, then the glass of the display.</source>
        <translation>让参与者先滑过桌上的几块布料，再滑过触觉屏。</translation>
    </message>
    <message>
        <source>Put one of these fabrics on the table and press its number: the display shows it. Let the participant stroke both as long as they like. Then take the next fabric.</source>
        <translation>把其中一块布料放在桌上，并按它的编号：触觉屏就会显示它。让参与者随意滑过两者，然后换下一块布料。</translation>
    </message>
    <message>
        <source>The display now shows %1.</source>
        <translation>触觉屏现在显示%1。</translation>
    </message>
    <message>
        <source>The display shows nothing now.</source>
        <translation>触觉屏现在不显示任何内容。</translation>
    </message>
</context>
<context>
    <name>study::app::FormPanel</name>
    <message>
        <source>Reason</source>
        <translation>原因</translation>
    </message>
    <message>
        <source>Store (Enter)</source>
        <translation>保存 (Enter)</translation>
    </message>
    <message>
        <source>Back (Esc)</source>
        <translation>返回 (Esc)</translation>
    </message>
</context>
<context>
    <name>study::app::GuidePage</name>
    <message>
        <source>Continue (Enter)</source>
        <translation>继续 (Enter)</translation>
    </message>
    <message>
        <source>Skip the preparation (G)</source>
        <translation>跳过准备 (G)</translation>
    </message>
    <message>
        <source>Break: %1:%2</source>
        <translation>休息：%1:%2</translation>
    </message>
</context>
<context>
    <name>study::app::KeyedTexts</name>
    <message>
        <source>%1    own: %2</source>
        <translation>%1    自定义：%2</translation>
    </message>
</context>
<context>
    <name>study::app::KeysPage</name>
    <message>
        <source>Press another key… (Enter)</source>
        <translation>按另一个键… (Enter)</translation>
    </message>
    <message>
        <source>Remove the other key (Delete)</source>
        <translation>移除另一个键 (Delete)</translation>
    </message>
    <message>
        <source>Remove all other keys</source>
        <translation>移除所有另设的键</translation>
    </message>
    <message>
        <source>Measure the latency of the operator…</source>
        <translation>测量主试的反应延迟…</translation>
    </message>
    <message>
        <source>Back (Esc)</source>
        <translation>返回 (Esc)</translation>
    </message>
    <message>
        <source>Acts of a session and their keys</source>
        <translation>实验中的操作及其按键</translation>
    </message>
    <message>
        <source>Act</source>
        <translation>操作</translation>
    </message>
    <message>
        <source>Key</source>
        <translation>按键</translation>
    </message>
    <message>
        <source>Other key</source>
        <translation>另设的键</translation>
    </message>
    <message>
        <source>Keys and pedals</source>
        <translation>按键与踏板</translation>
    </message>
    <message>
        <source>A foot pedal is a keyboard with one key. Give its key to an act. The usual key acts as well.</source>
        <translation>脚踏板就是只有一个键的键盘。请把它的键分配给一个操作。原来的按键仍然有效。</translation>
    </message>
    <message>
        <source>Fixed keys: letters choose a piece, digits and the point enter a number, Tab moves between the controls, Page Up and Page Down scroll. A barcode scanner enters the codes of pieces on the page of the tray. The Enter of a scanner stores no answer.</source>
        <translation>固定按键：字母选择布样，数字和小数点录入数值，Tab在控件之间切换，Page Up和Page Down滚动页面。条码扫描器在托盘页面上录入布样编码。扫描器的Enter不会保存回答。</translation>
    </message>
    <message>
        <source>Press the key or the pedal for “%1” now. Esc changes nothing.</source>
        <translation>现在请按用于“%1”的键或踏板。按Esc则不作更改。</translation>
    </message>
    <message>
        <source>Nothing is changed.</source>
        <translation>没有更改。</translation>
    </message>
    <message>
        <source>%1 now acts as “%2” in every session.</source>
        <translation>%1现在在每次实验中都用于“%2”。</translation>
    </message>
    <message>
        <source> It does not scroll in a session any more.</source>
        <translation> 它在实验中不再滚动页面。</translation>
    </message>
    <message>
        <source>This act has no other key.</source>
        <translation>这个操作没有另设的键。</translation>
    </message>
    <message>
        <source>“%1” has only its usual key now.</source>
        <translation>“%1”现在只有原来的按键。</translation>
    </message>
    <message>
        <source>Every act has only its usual key now.</source>
        <translation>每个操作现在都只有原来的按键。</translation>
    </message>
    <message>
        <source>–</source>
        <translation>–</translation>
    </message>
</context>
<context>
    <name>study::app::LatencyPage</name>
    <message>
        <source>Name of the operator</source>
        <translation>主试姓名</translation>
    </message>
    <message>
        <source>Begin with the bell (Enter)</source>
        <translation>用铃声开始 (Enter)</translation>
    </message>
    <message>
        <source>Begin with a flash, without sound</source>
        <translation>用闪光开始，无声</translation>
    </message>
    <message>
        <source>Ring the bell</source>
        <translation>响铃</translation>
    </message>
    <message>
        <source>Back (Esc)</source>
        <translation>返回 (Esc)</translation>
    </message>
    <message>
        <source>Latency of the operator</source>
        <translation>主试的反应延迟</translation>
    </message>
    <message>
        <source>Press the space bar, or your pedal, at each signal for two minutes. The report shows your median beside the times that your keys stamp. It subtracts nothing.</source>
        <translation>在两分钟内，每次出现信号时请按空格键或踏板。报告会把您的中位数与按键所记录的时间并列显示，不作扣减。</translation>
    </message>
    <message>
        <source>The bell is that of this computer. Ring it first. If you hear nothing, use the flash: then the lamp below turns bright. Esc stops the task, and nothing is stored.</source>
        <translation>铃声由这台计算机发出。请先试响一次。如果听不到，请用闪光：下方的灯会变亮。按Esc停止任务，不会保存任何内容。</translation>
    </message>
    <message>
        <source>The name of the operator is missing. Type it, then begin.</source>
        <translation>缺少主试姓名。请先输入，再开始。</translation>
    </message>
    <message>
        <source>%1 s left  ·  taps: %2</source>
        <translation>剩余%1 s  ·  按键：%2</translation>
    </message>
    <message>
        <source>Now</source>
        <translation>现在</translation>
    </message>
    <message>
        <source>Wait</source>
        <translation>等待</translation>
    </message>
    <message>
        <source>No signal was answered, so nothing is stored. Begin again.</source>
        <translation>没有对任何信号作出反应，因此没有保存。请重新开始。</translation>
    </message>
    <message>
        <source>Stored: median %1 ms, middle half from %2 to %3 ms, taps: %4, misses: %5, too early: %6.</source>
        <translation>已保存：中位数%1 ms，中间一半为%2至%3 ms，按键：%4，漏按：%5，过早：%6。</translation>
    </message>
    <message>
        <source>The task was stopped. Nothing is stored.</source>
        <translation>任务已停止。没有保存任何内容。</translation>
    </message>
</context>
<context>
    <name>study::app::LeaveGuard</name>
    <message>
        <source>Save and leave</source>
        <translation>保存并离开</translation>
    </message>
    <message>
        <source>The protocol has changes that are not saved.</source>
        <translation>实验方案有未保存的更改。</translation>
    </message>
    <message>
        <source>Leave without saving</source>
        <translation>不保存就离开</translation>
    </message>
    <message>
        <source>Stay (Esc)</source>
        <translation>留在这里 (Esc)</translation>
    </message>
</context>
<context>
    <name>study::app::LineProcess</name>
    <message>
        <source>the program ended</source>
        <translation>程序已结束</translation>
    </message>
</context>
<context>
    <name>study::app::MainWindow</name>
    <message>
        <source>Vis2Hap</source>
        <translation>Vis2Hap</translation>
    </message>
    <message>
        <source>%1 – Vis2Hap</source>
        <translation>%1 – Vis2Hap</translation>
    </message>
    <message>
        <source>No display is connected, so %1 would feel nothing. Connect a display, or rehearse without one.</source>
        <translation>没有连接触觉屏，%1会什么也摸不到。请连接触觉屏，或不用触觉屏进行预演。</translation>
    </message>
    <message>
        <source>%1 – %2 – Vis2Hap</source>
        <translation>%1 – %2 – Vis2Hap</translation>
    </message>
    <message>
        <source>Rehearsal – %1 – Vis2Hap</source>
        <translation>预演 – %1 – Vis2Hap</translation>
    </message>
</context>
<context>
    <name>study::app::MonitorWindow</name>
    <message>
        <source>just now</source>
        <translation>刚刚</translation>
    </message>
    <message>
        <source>1 day ago</source>
        <translation>1天前</translation>
    </message>
    <message>
        <source>%1 days ago</source>
        <translation>%1天前</translation>
    </message>
    <message>
        <source>%1 min ago</source>
        <translation>%1分钟前</translation>
    </message>
    <message>
        <source>free</source>
        <translation>空闲</translation>
    </message>
    <message>
        <source>%1/%2</source>
        <translation>%1/%2</translation>
    </message>
    <message>
        <source>Stage of every participant</source>
        <translation>每位参与者所处的阶段</translation>
    </message>
    <message>
        <source>Place</source>
        <translation>名额</translation>
    </message>
    <message>
        <source>Participant</source>
        <translation>参与者</translation>
    </message>
    <message>
        <source>Stage</source>
        <translation>阶段</translation>
    </message>
    <message>
        <source>Presentation</source>
        <translation>呈现</translation>
    </message>
    <message>
        <source>Answers</source>
        <translation>回答</translation>
    </message>
    <message>
        <source>Missing</source>
        <translation>缺失</translation>
    </message>
    <message>
        <source>Void</source>
        <translation>作废</translation>
    </message>
    <message>
        <source>Last event</source>
        <translation>最近事件</translation>
    </message>
    <message>
        <source>This window only reads the study. It updates every two seconds.</source>
        <translation>本窗口只读取研究，每两秒更新一次。</translation>
    </message>
    <message>
        <source>Missing: answers to voided presentations that have not been repeated yet.</source>
        <translation>缺失：作废后尚未重做的呈现的回答。</translation>
    </message>
    <message>
        <source>Close: Esc</source>
        <translation>关闭：Esc</translation>
    </message>
    <message>
        <source>Flags</source>
        <translation>异常提示</translation>
    </message>
    <message>
        <source>%1. The window tries again in two seconds.</source>
        <translation>%1。窗口将在两秒后重试。</translation>
    </message>
    <message>
        <source>%1 – monitor – Vis2Hap</source>
        <translation>%1 – 实时监视 – Vis2Hap</translation>
    </message>
    <message>
        <source>%1 of %2 answers  ·  %3</source>
        <translation>%1个回答，共%2个  ·  %3</translation>
    </message>
    <message>
        <source>blinded</source>
        <translation>盲态</translation>
    </message>
    <message>
        <source>unblinded</source>
        <translation>已揭盲</translation>
    </message>
    <message>
        <source>None so far.</source>
        <translation>目前没有。</translation>
    </message>
    <message>
        <source>%1 s ago</source>
        <translation>%1秒前</translation>
    </message>
    <message>
        <source>connected</source>
        <translation>已连接</translation>
    </message>
    <message>
        <source>lost</source>
        <translation>失去联系</translation>
    </message>
    <message>
        <source>unknown</source>
        <translation>未知</translation>
    </message>
    <message>
        <source>%1 at that time</source>
        <translation>当时%1条</translation>
    </message>
    <message>
        <source>Stations</source>
        <translation>工作站</translation>
    </message>
    <message>
        <source>Station</source>
        <translation>工作站</translation>
    </message>
    <message>
        <source>Connection</source>
        <translation>连接</translation>
    </message>
    <message>
        <source>Last sign of life</source>
        <translation>最后一次联系</translation>
    </message>
    <message>
        <source>Entries that wait there</source>
        <translation>在那里等待的记录</translation>
    </message>
    <message>
        <source>Program</source>
        <translation>程序</translation>
    </message>
    <message>
        <source>none is connected</source>
        <translation>没有已连接的工作站</translation>
    </message>
    <message>
        <source>Answers: %1</source>
        <translation>回答：%1</translation>
    </message>
    <message>
        <source>may wait</source>
        <translation>可能有等待的条目</translation>
    </message>
</context>
<context>
    <name>study::app::NewStudyPage</name>
    <message>
        <source>Number of participants</source>
        <translation>参与者人数</translation>
    </message>
    <message>
        <source>Seed of the running orders</source>
        <translation>呈现顺序的随机种子</translation>
    </message>
    <message>
        <source>Passphrase of the allocation key</source>
        <translation>分配密钥的密码短语</translation>
    </message>
    <message>
        <source>The same passphrase again</source>
        <translation>再次输入同一密码短语</translation>
    </message>
    <message>
        <source>Create the study (Enter)</source>
        <translation>创建研究 (Enter)</translation>
    </message>
    <message>
        <source>Back (Esc)</source>
        <translation>返回 (Esc)</translation>
    </message>
    <message>
        <source>New study</source>
        <translation>新建研究</translation>
    </message>
    <message>
        <source>No data set yet? Go back to “Data set from photographs”. To practise, `vis2hap fabrics make FOLDER` makes one. Sessions and progress reports need no passphrase. Means before the unblinding, and the unblinding itself, do. Nobody can restore a lost one.</source>
        <translation>还没有数据集？请返回“由照片建立数据集”。如果只是练习，可用`vis2hap fabrics make 文件夹`生成一个。实验和进度报告不需要密码短语。揭盲前查看均值以及揭盲本身需要密码短语。一旦丢失，谁也无法恢复。</translation>
    </message>
    <message>
        <source>empty: the number in the protocol</source>
        <translation>留空：采用实验方案中的人数</translation>
    </message>
    <message>
        <source>Language of the participants</source>
        <translation>参与者的语言</translation>
    </message>
    <message>
        <source>Progress of creating the study</source>
        <translation>创建研究的进度</translation>
    </message>
    <message>
        <source>Study folder</source>
        <translation>研究文件夹</translation>
    </message>
    <message>
        <source>a folder that does not exist yet</source>
        <translation>尚不存在的文件夹</translation>
    </message>
    <message>
        <source>Fabric data set</source>
        <translation>织物数据集</translation>
    </message>
    <message>
        <source>the folder that contains dataset.json</source>
        <translation>含有dataset.json的文件夹</translation>
    </message>
    <message>
        <source>Protocol file</source>
        <translation>实验方案文件</translation>
    </message>
    <message>
        <source>empty: the study of the paper</source>
        <translation>留空：论文中的研究</translation>
    </message>
    <message>
        <source>Participants</source>
        <translation>参与者</translation>
    </message>
    <message>
        <source>Seed</source>
        <translation>随机种子</translation>
    </message>
    <message>
        <source>Passphrase</source>
        <translation>密码短语</translation>
    </message>
    <message>
        <source>Passphrase again</source>
        <translation>再次输入密码短语</translation>
    </message>
    <message>
        <source>8 characters or more; it seals which condition is shown when</source>
        <translation>至少8个字符；它密封了何时呈现哪种条件</translation>
    </message>
    <message>
        <source>Browse…</source>
        <translation>浏览…</translation>
    </message>
    <message>
        <source>Browse for: %1</source>
        <translation>浏览：%1</translation>
    </message>
    <message>
        <source>Protocols (*.json)</source>
        <translation>实验方案 (*.json)</translation>
    </message>
    <message>
        <source>Folder for the new study</source>
        <translation>新研究的文件夹</translation>
    </message>
    <message>
        <source>No study folder is given. Type a folder that does not exist yet; the program creates it.</source>
        <translation>没有给出研究文件夹。请输入一个尚不存在的文件夹，程序会创建它。</translation>
    </message>
    <message>
        <source>No data set is given. Choose the fabric data set that the stimuli are made from.</source>
        <translation>没有给出数据集。请选择用来制作刺激的织物数据集。</translation>
    </message>
    <message>
        <source>The seed is not valid. Type a whole number, 0 or larger.</source>
        <translation>随机种子无效。请输入0或更大的整数。</translation>
    </message>
    <message>
        <source>The passphrase holds only blanks. Type letters, digits and signs.</source>
        <translation>密码短语只有空格。请输入字母、数字和符号。</translation>
    </message>
    <message>
        <source>The passphrase holds a character that nobody can type, such as a tab. Type it anew.</source>
        <translation>密码短语含有无法键入的字符，例如制表符。请重新输入。</translation>
    </message>
    <message>
        <source>The passphrase is too short. Type 8 characters or more, such as four words.</source>
        <translation>密码短语太短。请输入至少8个字符，例如四个词。</translation>
    </message>
    <message>
        <source>The two passphrases differ. Type the same one twice.</source>
        <translation>两次输入的密码短语不同。请输入两遍相同的密码短语。</translation>
    </message>
    <message>
        <source>The number of participants is not valid. Type a whole number, 1 or larger, or leave the line empty.</source>
        <translation>参与者人数无效。请输入1或更大的整数，或留空。</translation>
    </message>
    <message>
        <source>The program creates the study.</source>
        <translation>程序正在创建研究。</translation>
    </message>
    <message>
        <source>Cancel (Esc)</source>
        <translation>取消 (Esc)</translation>
    </message>
    <message>
        <source>The program stops this work.</source>
        <translation>程序正在停止这项工作。</translation>
    </message>
    <message>
        <source>Make or change a protocol…</source>
        <translation>制作或更改实验方案…</translation>
    </message>
</context>
<context>
    <name>study::app::OpenStudy</name>
    <message>
        <source>%1. First close the study in this window (Esc).</source>
        <translation>%1。请先在本窗口中关闭研究 (Esc)。</translation>
    </message>
</context>
<context>
    <name>study::app::PagePreview</name>
    <message>
        <source>Page to preview</source>
        <translation>要预览的页面</translation>
    </message>
    <message>
        <source>Question %1</source>
        <translation>问题%1</translation>
    </message>
    <message>
        <source>Tray before a presentation</source>
        <translation>呈现前的托盘</translation>
    </message>
    <message>
        <source>Participant&apos;s screen: presentation</source>
        <translation>参与者屏幕：呈现</translation>
    </message>
    <message>
        <source>Consent</source>
        <translation>知情同意</translation>
    </message>
    <message>
        <source>Participant&apos;s screen: consent</source>
        <translation>参与者屏幕：知情同意</translation>
    </message>
    <message>
        <source>Facts about the participant</source>
        <translation>参与者的基本信息</translation>
    </message>
    <message>
        <source>Getting to know the display</source>
        <translation>熟悉触觉屏</translation>
    </message>
    <message>
        <source>Learning the scale</source>
        <translation>学习量表</translation>
    </message>
    <message>
        <source>Participant&apos;s screen: scale</source>
        <translation>参与者屏幕：量表</translation>
    </message>
    <message>
        <source>Checklist of a sitting</source>
        <translation>场次的检查清单</translation>
    </message>
    <message>
        <source>Break</source>
        <translation>休息</translation>
    </message>
    <message>
        <source>Participant&apos;s screen: break</source>
        <translation>参与者屏幕：休息</translation>
    </message>
    <message>
        <source>Preview: %1</source>
        <translation>预览：%1</translation>
    </message>
    <message>
        <source>Participant&apos;s screen: waiting</source>
        <translation>参与者屏幕：等待</translation>
    </message>
    <message>
        <source>Participant&apos;s screen: welcome</source>
        <translation>参与者屏幕：欢迎</translation>
    </message>
    <message>
        <source>Participant&apos;s screen: facts</source>
        <translation>参与者屏幕：基本信息</translation>
    </message>
    <message>
        <source>Participant&apos;s screen: getting to know the display</source>
        <translation>参与者屏幕：熟悉触觉屏</translation>
    </message>
    <message>
        <source>Participant&apos;s screen: blindfold</source>
        <translation>参与者屏幕：眼罩</translation>
    </message>
    <message>
        <source>Participant&apos;s screen: last questions</source>
        <translation>参与者屏幕：最后的问题</translation>
    </message>
    <message>
        <source>Participant&apos;s screen: end</source>
        <translation>参与者屏幕：结束</translation>
    </message>
</context>
<context>
    <name>study::app::ParticipantPage</name>
    <message>
        <source>Show on this screen (Enter)</source>
        <translation>在这个屏幕上显示 (Enter)</translation>
    </message>
    <message>
        <source>Start the page</source>
        <translation>启动页面</translation>
    </message>
    <message>
        <source>Draw a new code</source>
        <translation>生成新的验证码</translation>
    </message>
    <message>
        <source>Back (Esc)</source>
        <translation>返回 (Esc)</translation>
    </message>
    <message>
        <source>Start the sound</source>
        <translation>启动声音</translation>
    </message>
    <message>
        <source>Play a prompt</source>
        <translation>播放提示语</translation>
    </message>
    <message>
        <source>Screen of the participant</source>
        <translation>参与者的屏幕</translation>
    </message>
    <message>
        <source>Screens</source>
        <translation>屏幕</translation>
    </message>
    <message>
        <source>Network of the page</source>
        <translation>页面所用的网络</translation>
    </message>
    <message>
        <source>Networks</source>
        <translation>网络</translation>
    </message>
    <message>
        <source>Masking noise</source>
        <translation>掩蔽噪声</translation>
    </message>
    <message>
        <source>Levels of the masking noise</source>
        <translation>掩蔽噪声的音量</translation>
    </message>
    <message>
        <source>No noise</source>
        <translation>无噪声</translation>
    </message>
    <message>
        <source>Quiet noise</source>
        <translation>轻噪声</translation>
    </message>
    <message>
        <source>Medium noise</source>
        <translation>中等噪声</translation>
    </message>
    <message>
        <source>Loud noise</source>
        <translation>强噪声</translation>
    </message>
    <message>
        <source>Prompts without a recording</source>
        <translation>没有录音的提示语</translation>
    </message>
    <message>
        <source>A computer voice speaks prompts without a recording</source>
        <translation>没有录音的提示语由计算机语音朗读</translation>
    </message>
    <message>
        <source>The operator speaks prompts without a recording</source>
        <translation>没有录音的提示语由主试朗读</translation>
    </message>
    <message>
        <source>Participant&apos;s screen</source>
        <translation>参与者屏幕</translation>
    </message>
    <message>
        <source>Shows the participant what to do: consent, questions, the scale, breaks. It shows no code, fabric or condition. The session works without it at any moment.</source>
        <translation>向参与者显示该做什么：知情同意、问题、量表、休息。它不显示编码、织物或条件。没有它，实验也随时可以进行。</translation>
    </message>
    <message>
        <source>Second screen of this computer</source>
        <translation>这台计算机的第二个屏幕</translation>
    </message>
    <message>
        <source>Tablet in the same room</source>
        <translation>同一房间里的平板电脑</translation>
    </message>
    <message>
        <source>The tablet&apos;s browser opens the address and enters the code. The connection is plain HTTP: everybody in the chosen network can read it. Choose a network of your own.</source>
        <translation>请在平板电脑的浏览器中打开地址并输入验证码。连接为普通HTTP：所选网络中的任何人都能读取。请选择您自己的网络。</translation>
    </message>
    <message>
        <source>Headphones</source>
        <translation>耳机</translation>
    </message>
    <message>
        <source>Screen %1%2, %3 × %4</source>
        <translation>屏幕%1%2，%3 × %4</translation>
    </message>
    <message>
        <source>%1 (this one)</source>
        <translation>%1（本屏幕）</translation>
    </message>
    <message>
        <source>This computer only: 127.0.0.1</source>
        <translation>仅限这台计算机：127.0.0.1</translation>
    </message>
    <message>
        <source>%1: %2 (readable in this network)</source>
        <translation>%1：%2（在此网络中可读取）</translation>
    </message>
    <message>
        <source>This screen is not connected any more. Choose another one.</source>
        <translation>这个屏幕已断开。请选择其他屏幕。</translation>
    </message>
    <message>
        <source>The study names no recordings.</source>
        <translation>研究没有指定录音。</translation>
    </message>
    <message>
        <source>Recordings of the study: %1.</source>
        <translation>研究的录音：%1。</translation>
    </message>
    <message>
        <source>%1 The voice %2 speaks the other prompts.</source>
        <translation>%1其余提示语由语音%2朗读。</translation>
    </message>
    <message>
        <source>%1 The operator speaks the other prompts.</source>
        <translation>%1其余提示语由主试朗读。</translation>
    </message>
    <message>
        <source>Stop the sound</source>
        <translation>停止声音</translation>
    </message>
    <message>
        <source>Playing on %1. %2</source>
        <translation>正在%1上播放。%2</translation>
    </message>
    <message>
        <source>Close the window (Enter)</source>
        <translation>关闭窗口 (Enter)</translation>
    </message>
    <message>
        <source>The participant&apos;s window is open.</source>
        <translation>参与者窗口已打开。</translation>
    </message>
    <message>
        <source>Stop the page</source>
        <translation>停止页面</translation>
    </message>
    <message>
        <source>Code: %1</source>
        <translation>验证码：%1</translation>
    </message>
    <message>
        <source>A browser at %1 shows the page. To use another one, draw a new code.</source>
        <translation>%1上的浏览器正在显示页面。要换用其他浏览器，请生成新的验证码。</translation>
    </message>
    <message>
        <source> Another browser at %1 was refused.</source>
        <translation> %1上的另一个浏览器被拒绝。</translation>
    </message>
    <message>
        <source>The code is void after %1 wrong tries. Draw a new code.</source>
        <translation>输错%1次后，验证码已失效。请生成新的验证码。</translation>
    </message>
    <message>
        <source>No browser has entered the code yet.</source>
        <translation>还没有浏览器输入验证码。</translation>
    </message>
    <message>
        <source>No browser has entered the code yet. Wrong codes: %1</source>
        <translation>还没有浏览器输入验证码。输错的验证码：%1</translation>
    </message>
</context>
<context>
    <name>study::app::ParticipantSide</name>
    <message>
        <source>The participant&apos;s page has stopped: %1</source>
        <translation>参与者页面已停止：%1</translation>
    </message>
</context>
<context>
    <name>study::app::ParticipantSound</name>
    <message>
        <source>The headphones do not read %1 back, because they have nothing for “%2”. Read it back yourself</source>
        <translation>耳机没有复述%1，因为缺少“%2”的录音或语音。请您自己复述</translation>
    </message>
    <message>
        <source>The sound has stopped: %1</source>
        <translation>声音已停止：%1</translation>
    </message>
</context>
<context>
    <name>study::app::ParticipantWindow</name>
    <message>
        <source>For the participant – Vis2Hap</source>
        <translation>参与者专用 – Vis2Hap</translation>
    </message>
</context>
<context>
    <name>study::app::PhaseDetail</name>
    <message>
        <source>Phase %1</source>
        <translation>阶段%1</translation>
    </message>
    <message>
        <source>Answers of phase %1</source>
        <translation>阶段%1的回答</translation>
    </message>
    <message>
        <source>The participant answers</source>
        <translation>参与者的回答方式</translation>
    </message>
    <message>
        <source>Pieces on the tray</source>
        <translation>托盘上的布样数</translation>
    </message>
    <message>
        <source>Presentations of blank glass</source>
        <translation>空白屏面的呈现数</translation>
    </message>
    <message>
        <source>Anchors with another fabric</source>
        <translation>用另一种织物的锚定呈现</translation>
    </message>
    <message>
        <source>Anchors felt twice</source>
        <translation>重复感受的锚定呈现</translation>
    </message>
    <message>
        <source>Leave as many pieces as possible on the tray from one to the next</source>
        <translation>相邻两次呈现之间尽量多保留托盘上的布样</translation>
    </message>
    <message>
        <source>From</source>
        <translation>从</translation>
    </message>
    <message>
        <source>To</source>
        <translation>到</translation>
    </message>
    <message>
        <source>In steps of</source>
        <translation>步长</translation>
    </message>
    <message>
        <source>Equal parts of the line</source>
        <translation>线的等分段数</translation>
    </message>
    <message>
        <source>Words of the scale, one a line, the lowest first</source>
        <translation>量表的词，每行一个，最低的在前</translation>
    </message>
    <message>
        <source>Questions of this phase</source>
        <translation>本阶段的问题</translation>
    </message>
    <message>
        <source>A short name for tables, such as Soft, and the sentence that the operator says.</source>
        <translation>用于表格的短名称，例如Soft，以及主试所说的句子。</translation>
    </message>
    <message>
        <source>%1 more questions are kept and not shown.</source>
        <translation>另有%1个问题被保留，但不显示。</translation>
    </message>
    <message>
        <source>Add a question</source>
        <translation>添加问题</translation>
    </message>
    <message>
        <source>Questions of phase %1</source>
        <translation>阶段%1的问题</translation>
    </message>
    <message>
        <source>Name of question %1</source>
        <translation>问题%1的名称</translation>
    </message>
    <message>
        <source>Question %1 of phase %2</source>
        <translation>阶段%2的问题%1</translation>
    </message>
    <message>
        <source>Sentence of question %1</source>
        <translation>问题%1的句子</translation>
    </message>
    <message>
        <source>How soft does the screen feel, compared with the fabric?</source>
        <translation>与布料相比，屏幕摸起来有多柔软？</translation>
    </message>
    <message>
        <source>Sentence of question %1 of phase %2</source>
        <translation>阶段%2的问题%1的句子</translation>
    </message>
    <message>
        <source>Question %1 is answered in own words</source>
        <translation>问题%1用自己的话回答</translation>
    </message>
    <message>
        <source>answered in own words</source>
        <translation>用自己的话回答</translation>
    </message>
    <message>
        <source>Remove question %1</source>
        <translation>移除问题%1</translation>
    </message>
    <message>
        <source>Speed or accuracy</source>
        <translation>速度或准确</translation>
    </message>
    <message>
        <source>Without instructions the phase runs once. With them it runs once under each, in balanced orders.</source>
        <translation>没有指导语时，本阶段进行一次；有指导语时，在每条指导语下各进行一次，顺序保持平衡。</translation>
    </message>
    <message>
        <source>Add an instruction</source>
        <translation>添加指导语</translation>
    </message>
    <message>
        <source>Instructions of phase %1</source>
        <translation>阶段%1的指导语</translation>
    </message>
    <message>
        <source>Name of instruction %1</source>
        <translation>指导语%1的名称</translation>
    </message>
    <message>
        <source>Aim of instruction %1</source>
        <translation>指导语%1的目标</translation>
    </message>
    <message>
        <source>neither</source>
        <translation>无要求</translation>
    </message>
    <message>
        <source>be fast</source>
        <translation>求快</translation>
    </message>
    <message>
        <source>be accurate</source>
        <translation>求准</translation>
    </message>
    <message>
        <source>Aim</source>
        <translation>目标</translation>
    </message>
    <message>
        <source>Seconds for an answer</source>
        <translation>回答时限（秒）</translation>
    </message>
    <message>
        <source>no limit</source>
        <translation>不限</translation>
    </message>
    <message>
        <source>Remove instruction %1</source>
        <translation>移除指导语%1</translation>
    </message>
    <message>
        <source>What the operator says</source>
        <translation>主试所说的话</translation>
    </message>
    <message>
        <source>empty: the usual sentence</source>
        <translation>留空：采用常用句子</translation>
    </message>
</context>
<context>
    <name>study::app::PhasesSection</name>
    <message>
        <source>Kind of a new phase</source>
        <translation>新阶段的类型</translation>
    </message>
    <message>
        <source>Add a phase</source>
        <translation>添加阶段</translation>
    </message>
    <message>
        <source>Move up</source>
        <translation>上移</translation>
    </message>
    <message>
        <source>Move down</source>
        <translation>下移</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>移除</translation>
    </message>
    <message>
        <source>Questions</source>
        <translation>问题</translation>
    </message>
    <message>
        <source>In a phase, every fabric is felt under every condition once. Its questions follow one another. Phases follow in this order.</source>
        <translation>在一个阶段里，每种织物在每种条件下各感受一次，该阶段的问题依次提出。各阶段按此顺序进行。</translation>
    </message>
    <message>
        <source>Phases in their order</source>
        <translation>按顺序排列的阶段</translation>
    </message>
    <message>
        <source>Phases</source>
        <translation>阶段</translation>
    </message>
    <message>
        <source>%1    %2: %3</source>
        <translation>%1    %2：%3</translation>
    </message>
    <message>
        <source>choose the fabric among pieces</source>
        <translation>从布样中选出织物</translation>
    </message>
    <message>
        <source>rate with numbers</source>
        <translation>用数字评分</translation>
    </message>
    <message>
        <source>rate with words</source>
        <translation>用词评分</translation>
    </message>
    <message>
        <source>same or different</source>
        <translation>相同或不同</translation>
    </message>
    <message>
        <source>own words</source>
        <translation>自己的话</translation>
    </message>
</context>
<context>
    <name>study::app::PhotographForm</name>
    <message>
        <source>Grey photograph</source>
        <translation>照片灰度</translation>
    </message>
    <message>
        <source>Shape from shading</source>
        <translation>由明暗恢复的形状</translation>
    </message>
    <message>
        <source>Generated height</source>
        <translation>生成的高度</translation>
    </message>
    <message>
        <source>Generated friction</source>
        <translation>生成的摩擦</translation>
    </message>
    <message>
        <source>Generated height and friction</source>
        <translation>生成的高度和摩擦</translation>
    </message>
    <message>
        <source>Photograph or folder</source>
        <translation>照片或文件夹</translation>
    </message>
    <message>
        <source>Browse files…</source>
        <translation>选择文件…</translation>
    </message>
    <message>
        <source>Browse folders…</source>
        <translation>选择文件夹…</translation>
    </message>
    <message>
        <source>Add (Enter)</source>
        <translation>添加 (Enter)</translation>
    </message>
    <message>
        <source>Check the photographs</source>
        <translation>检查照片</translation>
    </message>
    <message>
        <source>Folder of the new data set</source>
        <translation>新数据集的文件夹</translation>
    </message>
    <message>
        <source>Browse…</source>
        <translation>浏览…</translation>
    </message>
    <message>
        <source>Write the data set</source>
        <translation>写入数据集</translation>
    </message>
    <message>
        <source>Render</source>
        <translation>渲染</translation>
    </message>
    <message>
        <source>Go on to the new study</source>
        <translation>前往新建研究</translation>
    </message>
    <message>
        <source>Back (Esc)</source>
        <translation>返回 (Esc)</translation>
    </message>
    <message>
        <source>Data set from photographs</source>
        <translation>由照片建立数据集</translation>
    </message>
    <message>
        <source>1  Photographs</source>
        <translation>1  照片</translation>
    </message>
    <message>
        <source>Take all pictures with one camera, from straight above, at the same distance. Lay a ruler into one of them.</source>
        <translation>请用同一台相机、从正上方、在相同距离拍摄所有照片，并在其中一张里放一把尺子。</translation>
    </message>
    <message>
        <source>an image file, or a folder with images</source>
        <translation>图像文件，或含有图像的文件夹</translation>
    </message>
    <message>
        <source>2  Scale</source>
        <translation>2  比例</translation>
    </message>
    <message>
        <source>One scale holds for all photographs. Give one of the three lengths, or leave them if you do not know it.</source>
        <translation>所有照片共用一个比例。请给出三个长度之一；如果不知道，就不填。</translation>
    </message>
    <message>
        <source>Warnings about the photographs</source>
        <translation>关于照片的警告</translation>
    </message>
    <message>
        <source>3  Check</source>
        <translation>3  检查</translation>
    </message>
    <message>
        <source>Does each photograph resemble those that the networks learned from? Otherwise height and friction are guesses.</source>
        <translation>每张照片是否与网络训练所用的照片相似？如果不相似，高度和摩擦就只是猜测。</translation>
    </message>
    <message>
        <source>4  Data set</source>
        <translation>4  数据集</translation>
    </message>
    <message>
        <source>The program makes this folder. Nothing that exists is overwritten.</source>
        <translation>程序会创建这个文件夹，不会覆盖任何已有内容。</translation>
    </message>
    <message>
        <source>a folder that does not exist yet</source>
        <translation>尚不存在的文件夹</translation>
    </message>
    <message>
        <source>5  Conditions and friction images</source>
        <translation>5  条件和摩擦图像</translation>
    </message>
    <message>
        <source>Choose the conditions. If you wish, look at the images that participants will feel: bright means high friction.</source>
        <translation>请选择条件。如果愿意，可以查看参与者将要触摸的图像：越亮表示摩擦越大。</translation>
    </message>
    <message>
        <source>6  Study</source>
        <translation>6  研究</translation>
    </message>
    <message>
        <source>The program writes a protocol beside the data set: the questions of the paper under the chosen conditions. You may edit it.</source>
        <translation>程序会在数据集旁边写一个实验方案：在所选条件下提出论文中的问题。您可以编辑它。</translation>
    </message>
</context>
<context>
    <name>study::app::PhotographList</name>
    <message>
        <source>Each file is a fabric</source>
        <translation>每个文件是一种织物</translation>
    </message>
    <message>
        <source>Each folder is a fabric</source>
        <translation>每个文件夹是一种织物</translation>
    </message>
    <message>
        <source>Name of the fabric</source>
        <translation>织物名称</translation>
    </message>
    <message>
        <source>Remove the photograph (Del)</source>
        <translation>移除照片 (Del)</translation>
    </message>
    <message>
        <source>Photographs</source>
        <translation>照片</translation>
    </message>
    <message>
        <source>Fabric</source>
        <translation>织物</translation>
    </message>
    <message>
        <source>Photograph</source>
        <translation>照片</translation>
    </message>
    <message>
        <source>Size, px</source>
        <translation>尺寸，px</translation>
    </message>
    <message>
        <source>Check</source>
        <translation>检查</translation>
    </message>
    <message>
        <source>Name of the chosen fabric (Enter: the next one)</source>
        <translation>所选织物的名称（Enter：下一个）</translation>
    </message>
    <message>
        <source>%1 × %2</source>
        <translation>%1 × %2</translation>
    </message>
    <message>
        <source>%1 %2, %3 %4</source>
        <translation>%1%2，%3%4</translation>
    </message>
    <message>
        <source>photograph</source>
        <translation>张照片</translation>
    </message>
    <message>
        <source>photographs</source>
        <translation>张照片</translation>
    </message>
    <message>
        <source>fabric</source>
        <translation>种织物</translation>
    </message>
    <message>
        <source>fabrics</source>
        <translation>种织物</translation>
    </message>
    <message>
        <source>This fabric has no name. Type a name, such as the one on its label.</source>
        <translation>这种织物没有名称。请输入名称，例如标签上的名称。</translation>
    </message>
    <message>
        <source>The name &quot;%1&quot; %2. A name has %3.</source>
        <translation>名称“%1”%2。名称应为%3。</translation>
    </message>
    <message>
        <source>Two fabrics have the name &quot;%1&quot;. Give one of them another name.</source>
        <translation>有两种织物名为“%1”。请给其中一种换个名称。</translation>
    </message>
    <message>
        <source>no warning</source>
        <translation>没有警告</translation>
    </message>
    <message>
        <source>1 warning</source>
        <translation>1个警告</translation>
    </message>
    <message>
        <source>%1 warnings</source>
        <translation>%1个警告</translation>
    </message>
</context>
<context>
    <name>study::app::PhotographRuler</name>
    <message>
        <source>Ruler on the photograph</source>
        <translation>照片上的尺子</translation>
    </message>
    <message>
        <source>No point is marked.</source>
        <translation>没有标出点。</translation>
    </message>
    <message>
        <source>One point is marked.</source>
        <translation>已标出一个点。</translation>
    </message>
    <message>
        <source>Two points are marked, %1 px apart.</source>
        <translation>已标出两个点，相距%1 px。</translation>
    </message>
</context>
<context>
    <name>study::app::PhotographScale</name>
    <message>
        <source>Width of one pixel, mm</source>
        <translation>像素宽度，mm</translation>
    </message>
    <message>
        <source>Width of the photograph, mm</source>
        <translation>照片宽度，mm</translation>
    </message>
    <message>
        <source>Distance of the two points, mm</source>
        <translation>两点之间的距离，mm</translation>
    </message>
    <message>
        <source>not known</source>
        <translation>未知</translation>
    </message>
    <message>
        <source>not measured</source>
        <translation>未测量</translation>
    </message>
    <message>
        <source>or the width of the whole photograph, mm</source>
        <translation>或整张照片的宽度，mm</translation>
    </message>
    <message>
        <source>or mark two points on the picture; their distance, mm</source>
        <translation>或在图片上标出两个点；它们的距离，mm</translation>
    </message>
    <message>
        <source>Click two points. By keys: arrows move the cross (Shift: in small steps), Space sets a point.</source>
        <translation>请点击两个点。用键盘：方向键移动十字（加Shift：小步移动），空格键设定一个点。</translation>
    </message>
    <message>
        <source>This is not a number. Type millimetres, such as 0.05 or 120.</source>
        <translation>这不是数字。请输入毫米数，例如0.05或120。</translation>
    </message>
    <message>
        <source>This length is not larger than 0. Type millimetres, such as 0.05 or 120.</source>
        <translation>这个长度不大于0。请输入毫米数，例如0.05或120。</translation>
    </message>
    <message>
        <source>The two points are at the same place. Mark points that lie far apart.</source>
        <translation>两个点在同一位置。请标出相距较远的点。</translation>
    </message>
    <message>
        <source>One pixel would be %1 mm wide (expected %2 to %3 mm). Check the number and its unit.</source>
        <translation>一个像素的宽度会是%1 mm（应为%2至%3 mm）。请检查数值及其单位。</translation>
    </message>
    <message>
        <source>The picture shows %1 × %2 mm of fabric.</source>
        <translation>图片显示%1 × %2 mm的织物。</translation>
    </message>
    <message>
        <source>The scale is not known. The program then assumes an ordinary weave.</source>
        <translation>比例未知。程序将假定为普通组织。</translation>
    </message>
</context>
<context>
    <name>study::app::PhotographsPage</name>
    <message>
        <source>%1 more files were refused.</source>
        <translation>另有%1个文件被拒绝。</translation>
    </message>
    <message>
        <source>Photographs</source>
        <translation>照片</translation>
    </message>
    <message>
        <source>Images (*.png *.jpg *.jpeg *.bmp *.tif *.tiff);;All files (*)</source>
        <translation>图像 (*.png *.jpg *.jpeg *.bmp *.tif *.tiff);;所有文件 (*)</translation>
    </message>
    <message>
        <source>Folder of photographs</source>
        <translation>照片文件夹</translation>
    </message>
    <message>
        <source>Folder that receives the data set</source>
        <translation>存放数据集的文件夹</translation>
    </message>
    <message>
        <source>No photograph is given. Type a file or folder, or choose it with Browse.</source>
        <translation>没有给出照片。请输入文件或文件夹，或用“浏览”选择。</translation>
    </message>
    <message>
        <source>The program reads the photographs. Esc stops it.</source>
        <translation>程序正在读取照片。按Esc停止。</translation>
    </message>
    <message>
        <source>The program compares the photographs with those it knows.</source>
        <translation>程序正在把这些照片与它所知的照片比较。</translation>
    </message>
    <message>
        <source>No warnings. The photographs resemble those that the networks learned from.</source>
        <translation>没有警告。这些照片与网络训练所用的照片相似。</translation>
    </message>
    <message>
        <source>%1 of %2 photographs have warnings. You may go on, or take them again.</source>
        <translation>%2张照片中有%1张带有警告。您可以继续，也可以重新拍摄。</translation>
    </message>
    <message>
        <source>No folder is given. Type a folder that does not exist yet.</source>
        <translation>没有给出文件夹。请输入一个尚不存在的文件夹。</translation>
    </message>
    <message>
        <source>The program writes the data set.</source>
        <translation>程序正在写入数据集。</translation>
    </message>
    <message>
        <source>Written: %1 (fabrics: %2, photographs: %3)</source>
        <translation>已写入：%1（织物：%2，照片：%3）</translation>
    </message>
    <message>
        <source>No condition is chosen. Choose one or more of the five.</source>
        <translation>尚未选择条件。请从五种条件中选择一种或几种。</translation>
    </message>
    <message>
        <source>The program writes the protocol.</source>
        <translation>程序正在写入实验方案。</translation>
    </message>
    <message>
        <source>The program renders the friction images. This can take minutes.</source>
        <translation>程序正在渲染摩擦图像。这可能需要几分钟。</translation>
    </message>
    <message>
        <source>Friction images: %1</source>
        <translation>摩擦图像：%1</translation>
    </message>
    <message>
        <source>Back (Esc)</source>
        <translation>返回 (Esc)</translation>
    </message>
    <message>
        <source>Stop (Esc)</source>
        <translation>停止 (Esc)</translation>
    </message>
</context>
<context>
    <name>study::app::QuestionHead</name>
    <message>
        <source>Instruction of this block: “%1”</source>
        <translation>本组块的指导语：“%1”</translation>
    </message>
    <message>
        <source>Read this aloud now: “%1”</source>
        <translation>现在请朗读：“%1”</translation>
    </message>
    <message>
        <source>Before you continue, say what the next block asks for: “%1”</source>
        <translation>继续之前，请说明下一个组块的要求：“%1”</translation>
    </message>
    <message>
        <source>Presentation %1    ·    %2    ·    say:</source>
        <translation>呈现%1    ·    %2    ·    请说：</translation>
    </message>
    <message>
        <source>“%1”</source>
        <translation>“%1”</translation>
    </message>
</context>
<context>
    <name>study::app::QuestionPage</name>
    <message>
        <source>The answer begins (F9)</source>
        <translation>回答开始 (F9)</translation>
    </message>
    <message>
        <source>Store the answer (Enter)</source>
        <translation>保存回答 (Enter)</translation>
    </message>
    <message>
        <source>Next tray: %1</source>
        <translation>下一次托盘：%1</translation>
    </message>
    <message>
        <source>The answer begins</source>
        <translation>回答开始</translation>
    </message>
    <message>
        <source>The beginning is stamped ✓</source>
        <translation>开始时刻已记录 ✓</translation>
    </message>
    <message>
        <source>Go to the second entry</source>
        <translation>进行第二次录入</translation>
    </message>
    <message>
        <source>Store the answer</source>
        <translation>保存回答</translation>
    </message>
    <message>
        <source>Second entry.</source>
        <translation>第二次录入。</translation>
    </message>
    <message>
        <source>Press Enter, then enter the same answer again.</source>
        <translation>按Enter，然后再次录入同一回答。</translation>
    </message>
    <message>
        <source>Press Enter to store it.</source>
        <translation>按Enter保存。</translation>
    </message>
</context>
<context>
    <name>study::app::RatingControls</name>
    <message>
        <source>Rating that the participant says</source>
        <translation>参与者说出的评分</translation>
    </message>
    <message>
        <source>Read back: “%1.”</source>
        <translation>请复述：“%1。”</translation>
    </message>
    <message>
        <source>Type the number that the participant says, or click on the line.</source>
        <translation>请输入参与者说出的数字，或在线上点击。</translation>
    </message>
</context>
<context>
    <name>study::app::ReasonPanel</name>
    <message>
        <source>Code of the participant</source>
        <translation>参与者编号</translation>
    </message>
    <message>
        <source>Participant&apos;s code</source>
        <translation>参与者编号</translation>
    </message>
    <message>
        <source>This ends the session for good. Type %1 in the first line, or press Esc to go back.</source>
        <translation>这将永久结束实验。请在第一行输入%1，或按Esc返回。</translation>
    </message>
    <message>
        <source>“%1” is not the code of this participant. Type %2 in the first line, or press Esc to go back.</source>
        <translation>“%1”不是这位参与者的编码。请在第一行输入%2，或按Esc返回。</translation>
    </message>
    <message>
        <source>Note</source>
        <translation>备注</translation>
    </message>
    <message>
        <source>Describe the event in a few words. The program stores the note with its time.</source>
        <translation>请用几个词描述事件。程序会保存备注及其时间。</translation>
    </message>
    <message>
        <source>Store the note (Enter)</source>
        <translation>保存备注 (Enter)</translation>
    </message>
    <message>
        <source>The note is empty. Write a few words, or press Esc to go back.</source>
        <translation>备注是空的。请写几个词，或按Esc返回。</translation>
    </message>
    <message>
        <source>Flag the last presentation</source>
        <translation>标记最近一次呈现</translation>
    </message>
    <message>
        <source>Flag presentation %1</source>
        <translation>标记呈现%1</translation>
    </message>
    <message>
        <source>The presentation stays in the analysis and is marked for inspection. You may add a reason.</source>
        <translation>这次呈现仍计入分析，并标出供检查。您可以补充原因。</translation>
    </message>
    <message>
        <source>Reason</source>
        <translation>原因</translation>
    </message>
    <message>
        <source>Flag the presentation (Enter)</source>
        <translation>标记呈现 (Enter)</translation>
    </message>
    <message>
        <source>Void the last presentation</source>
        <translation>作废最近一次呈现</translation>
    </message>
    <message>
        <source>Void presentation %1</source>
        <translation>作废呈现%1</translation>
    </message>
    <message>
        <source>Its answers are kept but not analysed. The presentation is repeated at the end of this block under another code. Why was it invalid?</source>
        <translation>其回答会保留，但不计入分析。这次呈现将在本组块末尾以另一编码重做。它为什么无效？</translation>
    </message>
    <message>
        <source>Void the presentation (Enter)</source>
        <translation>作废呈现 (Enter)</translation>
    </message>
    <message>
        <source>The participant withdraws</source>
        <translation>参与者退出实验</translation>
    </message>
    <message>
        <source>This ends the session of %1 permanently. The answers so far are kept, and the study&apos;s owner gives the place out again. To stop for today, press Esc and then Q. Which reason did the participant give?</source>
        <translation>这将永久结束%1的实验。已有的回答会保留，这个名额由研究的所有者重新分配。如果只是今天停止，请按Esc，再按Q。参与者给出了什么理由？</translation>
    </message>
    <message>
        <source>This ends the session of %1 permanently. The answers so far are kept, and another participant can take the place. To stop for today, press Esc and then Q. Which reason did the participant give?</source>
        <translation>这将永久结束%1的实验。已有的回答会保留，另一位参与者可以使用这个名额。如果只是今天停止，请按Esc，再按Q。参与者给出了什么理由？</translation>
    </message>
    <message>
        <source>End the session (Enter)</source>
        <translation>结束实验 (Enter)</translation>
    </message>
    <message>
        <source>The participant need not give a reason. Press Enter again to end the session, Esc to go back.</source>
        <translation>参与者无需说明理由。再按一次Enter结束实验，按Esc返回。</translation>
    </message>
    <message>
        <source>Usual reasons</source>
        <translation>常见原因</translation>
    </message>
    <message>
        <source>Wrong piece on the tray</source>
        <translation>托盘上的布样放错</translation>
    </message>
    <message>
        <source>Disturbance in the room</source>
        <translation>房间里有干扰</translation>
    </message>
    <message>
        <source>Fault of the display</source>
        <translation>触觉屏故障</translation>
    </message>
    <message>
        <source>Slip of the operator</source>
        <translation>主试操作失误</translation>
    </message>
    <message>
        <source>%1 (Alt %2)</source>
        <translation>%1 (Alt %2)</translation>
    </message>
    <message>
        <source>Write a short reason, or choose one with Alt 1 to Alt 4. Press Esc to go back.</source>
        <translation>请简要写明原因，或按Alt 1至Alt 4选择一个。按Esc返回。</translation>
    </message>
</context>
<context>
    <name>study::app::RehearsalPage</name>
    <message>
        <source>a display</source>
        <translation>触觉屏</translation>
    </message>
    <message>
        <source>a test pattern that was felt</source>
        <translation>已触摸的测试图案</translation>
    </message>
    <message>
        <source>the masking sound</source>
        <translation>掩蔽声音</translation>
    </message>
    <message>
        <source>the sheets</source>
        <translation>打印单</translation>
    </message>
    <message>
        <source>one fabric piece</source>
        <translation>一块布样</translation>
    </message>
    <message>
        <source>%1 fabric pieces</source>
        <translation>%1块布样</translation>
    </message>
    <message>
        <source>a disk in order</source>
        <translation>正常的磁盘</translation>
    </message>
    <message>
        <source>a clock in order</source>
        <translation>正常的时钟</translation>
    </message>
    <message>
        <source>a session played to its end</source>
        <translation>完整演练的实验</translation>
    </message>
    <message>
        <source>Code of a fabric piece</source>
        <translation>布样编码</translation>
    </message>
    <message>
        <source>Play the session (F5)</source>
        <translation>演练实验 (F5)</translation>
    </message>
    <message>
        <source>Display… (F6)</source>
        <translation>触觉屏… (F6)</translation>
    </message>
    <message>
        <source>Check again (F7)</source>
        <translation>重新检查 (F7)</translation>
    </message>
    <message>
        <source>Back (Esc)</source>
        <translation>返回 (Esc)</translation>
    </message>
    <message>
        <source>Rehearsal</source>
        <translation>预演</translation>
    </message>
    <message>
        <source>Try everything once before the first participant comes. Nothing of it becomes data.</source>
        <translation>在第一位参与者到来之前，请把一切都试一遍。其中的任何内容都不会成为数据。</translation>
    </message>
    <message>
        <source>An edge or a grating was felt on the display.</source>
        <translation>在触觉屏上摸到了边缘或光栅。</translation>
    </message>
    <message>
        <source>With the headphones on, the masking sound is heard, and the display and the fabrics are not. F4 plays it.</source>
        <translation>戴上耳机后，能听到掩蔽声音，听不到触觉屏和布料的声音。按F4播放。</translation>
    </message>
    <message>
        <source>The sheets are printed: labels on the pieces, consent, facts, scale.</source>
        <translation>打印单已打印：布样标签、知情同意、基本信息、量表。</translation>
    </message>
    <message>
        <source>The session was left before its end. Play it again to see all of it.</source>
        <translation>实验在结束前退出了。请再演练一次，以便看到全部内容。</translation>
    </message>
    <message>
        <source>%1 is there.</source>
        <translation>%1已就位。</translation>
    </message>
    <message>
        <source>%1 was read before.</source>
        <translation>%1先前已读取。</translation>
    </message>
    <message>
        <source>%1 is no code of this study. Read the label on the piece.</source>
        <translation>%1不是本研究的编码。请看布样上的标签。</translation>
    </message>
    <message>
        <source>Display: %1 is connected.</source>
        <translation>触觉屏：%1已连接。</translation>
    </message>
    <message>
        <source>No display is connected. Choose one on the page of the display.</source>
        <translation>没有连接触觉屏。请在“触觉屏”页面选择一个。</translation>
    </message>
    <message>
        <source>Every fabric piece is there.</source>
        <translation>所有布样都已就位。</translation>
    </message>
    <message>
        <source>Scan or type the code of every fabric piece. Still to come: %1</source>
        <translation>请扫描或输入每块布样的编码。还缺：%1</translation>
    </message>
    <message>
        <source>The disk is in order.</source>
        <translation>磁盘正常。</translation>
    </message>
    <message>
        <source>The clock is in order.</source>
        <translation>时钟正常。</translation>
    </message>
    <message>
        <source>The clock was not compared with the study.</source>
        <translation>时钟尚未与研究核对。</translation>
    </message>
    <message>
        <source>The session was played to its end.</source>
        <translation>实验已演练到结束。</translation>
    </message>
    <message>
        <source>Play the session: every page, a few presentations of each part, a break. Its images are patterns, not those of the study.</source>
        <translation>请演练实验：每个页面、每个部分的几次呈现、一次休息。其中的图像是图案，不是本研究的图像。</translation>
    </message>
    <message>
        <source>Ready for %1.</source>
        <translation>已为%1准备就绪。</translation>
    </message>
    <message>
        <source>Still missing: %1.</source>
        <translation>还缺：%1。</translation>
    </message>
</context>
<context>
    <name>study::app::ScaleLine</name>
    <message>
        <source>Scale line from %1 to %2</source>
        <translation>%1至%2的量表线</translation>
    </message>
    <message>
        <source>nothing chosen</source>
        <translation>未选择</translation>
    </message>
</context>
<context>
    <name>study::app::ScaleTrainingPage</name>
    <message>
        <source>Number that the participant says for the mark</source>
        <translation>参与者说出的记号所对应的数字</translation>
    </message>
    <message>
        <source>Continue (Enter)</source>
        <translation>继续 (Enter)</translation>
    </message>
    <message>
        <source>The participant knows the scale (G)</source>
        <translation>参与者已掌握量表 (G)</translation>
    </message>
    <message>
        <source>Repeat the scale</source>
        <translation>重复量表练习</translation>
    </message>
    <message>
        <source>Show this line again. Say: “%1”</source>
        <translation>请再次出示这条线，并说：“%1”</translation>
    </message>
    <message>
        <source>Show this line again, from %1 to %2.</source>
        <translation>请再次出示这条线，从%1到%2。</translation>
    </message>
    <message>
        <source>Learn the scale</source>
        <translation>学习量表</translation>
    </message>
    <message>
        <source>Show this line to the participant. Its sections are equal, and only its ends have numbers.</source>
        <translation>请向参与者出示这条线。各段等长，只有两端有数字。</translation>
    </message>
    <message>
        <source>Show this line to the participant. Only its ends have numbers.</source>
        <translation>请向参与者出示这条线。只有两端有数字。</translation>
    </message>
    <message>
        <source>Let the participant touch sandpaper, then silk. Say: “%1”</source>
        <translation>让参与者先摸砂纸，再摸丝绸，并说：“%1”</translation>
    </message>
    <message>
        <source>Let the participant touch two pieces of the same fabric. Say: “%1”</source>
        <translation>让参与者摸两块相同的布料，并说：“%1”</translation>
    </message>
    <message>
        <source>Ask: “%1”</source>
        <translation>请问：“%1”</translation>
    </message>
    <message>
        <source>Mark %1; right in a row: %2 of 3. Ask: “%3”</source>
        <translation>记号%1；连续答对：%2，共需3次。请问：“%3”</translation>
    </message>
    <message>
        <source>Store this number (Enter)</source>
        <translation>保存这个数字 (Enter)</translation>
    </message>
    <message>
        <source>The participant knows the scale (Enter)</source>
        <translation>参与者已掌握量表 (Enter)</translation>
    </message>
    <message>
        <source>The participant said %1. The mark was exactly there.</source>
        <translation>参与者说%1。记号正好在那里。</translation>
    </message>
    <message>
        <source>The participant said %1, and the mark was at %2. This is very close.</source>
        <translation>参与者说%1，记号在%2。非常接近。</translation>
    </message>
    <message>
        <source>%1 too high</source>
        <translation>偏高%1</translation>
    </message>
    <message>
        <source>%1 too low</source>
        <translation>偏低%1</translation>
    </message>
    <message>
        <source>The participant said %1, and the mark was at %2. This is close, %3.</source>
        <translation>参与者说%1，记号在%2。接近，%3。</translation>
    </message>
    <message>
        <source>The participant said %1, and the mark was at %2. This is %3. Show the ends and the sections again.</source>
        <translation>参与者说%1，记号在%2。%3。请再次出示两端和各段。</translation>
    </message>
    <message>
        <source>%1 Press G to skip this if the participant already knows the scale.</source>
        <translation>%1如果参与者已掌握量表，按G跳过。</translation>
    </message>
    <message>
        <source>Let the participant touch your materials (usually sandpaper, then silk). Say: “%1”</source>
        <translation>让参与者摸本研究的材料（通常是先砂纸，再丝绸），并说：“%1”</translation>
    </message>
    <message>
        <source>Let the participant touch your materials (usually two pieces of the same fabric). Say: “%1”</source>
        <translation>让参与者摸本研究的材料（通常是两块相同的布料），并说：“%1”</translation>
    </message>
</context>
<context>
    <name>study::app::ScreenCover</name>
    <message>
        <source>Cover of the haptic display</source>
        <translation>触觉屏的覆盖窗口</translation>
    </message>
</context>
<context>
    <name>study::app::SectionTabs</name>
    <message>
        <source>Section of the protocol</source>
        <translation>实验方案的部分</translation>
    </message>
    <message>
        <source>1  Study</source>
        <translation>1  研究</translation>
    </message>
    <message>
        <source>2  Conditions</source>
        <translation>2  条件</translation>
    </message>
    <message>
        <source>3  Questions</source>
        <translation>3  问题</translation>
    </message>
    <message>
        <source>4  Course</source>
        <translation>4  进程</translation>
    </message>
    <message>
        <source>5  Texts</source>
        <translation>5  文本</translation>
    </message>
    <message>
        <source>6  Analysis</source>
        <translation>6  分析</translation>
    </message>
</context>
<context>
    <name>study::app::ServerBar</name>
    <message>
        <source>Station %1: the server takes nothing from this station now.</source>
        <translation>工作站 %1：服务器目前不接收本工作站的任何内容。</translation>
    </message>
    <message>
        <source>Station %1: the server cannot be reached.</source>
        <translation>工作站 %1：无法连接服务器。</translation>
    </message>
    <message>
        <source>No entry waits on this computer.</source>
        <translation>本机没有等待发送的记录。</translation>
    </message>
    <message>
        <source>Entries that wait on this computer: %1. They are sent when the server takes them.</source>
        <translation>本机等待发送的记录：%1 条。服务器可以接收时会自动发送。</translation>
    </message>
    <message>
        <source>Reason: %1</source>
        <translation>原因：%1</translation>
    </message>
    <message>
        <source>Station %1: entries wait on this computer: %2. They are being sent.</source>
        <translation>工作站 %1：本机等待发送的记录：%2 条。正在发送。</translation>
    </message>
    <message>
        <source>The server lost entries after entry %1 that this station had seen. Ask the study&apos;s owner before anybody goes on.</source>
        <translation>服务器缺少第 %1 条之后、本工作站曾见过的记录。在任何人继续之前，请询问研究的所有者。</translation>
    </message>
    <message>
        <source>The clock of this computer is %1 s ahead of the server&apos;s clock. Set it before the next session.</source>
        <translation>本机时钟比服务器时钟快 %1 秒。请在下一次实验前校准。</translation>
    </message>
    <message>
        <source>The clock of this computer is %1 s behind the server&apos;s clock. Set it before the next session.</source>
        <translation>本机时钟比服务器时钟慢 %1 秒。请在下一次实验前校准。</translation>
    </message>
    <message>
        <source>Station %1: every answer is on the server.</source>
        <translation>工作站 %1：所有回答都已存到服务器。</translation>
    </message>
</context>
<context>
    <name>study::app::ServerMonitor</name>
    <message>
        <source>The server of %1 cannot be reached. The window shows what it read last and tries again every two seconds.</source>
        <translation>无法连接%1的服务器。窗口显示上次读到的内容，并每两秒重试一次。</translation>
    </message>
    <message>
        <source>%1. The window tries again in two seconds.</source>
        <translation>%1。窗口将在两秒后重试。</translation>
    </message>
</context>
<context>
    <name>study::app::SessionController</name>
    <message>
        <source>The presentation is flagged.</source>
        <translation>呈现已标记。</translation>
    </message>
    <message>
        <source>The note is stored.</source>
        <translation>备注已保存。</translation>
    </message>
    <message>
        <source>The answer is corrected. The study keeps the old answer.</source>
        <translation>回答已更正。研究会保留旧回答。</translation>
    </message>
    <message>
        <source>The presentation is void. It will be repeated under another code.</source>
        <translation>呈现已作废，将以另一编码重做。</translation>
    </message>
    <message>
        <source>%1. The session is paused and no answer is lost. Fix the problem, then press Enter to continue.</source>
        <translation>%1。实验已暂停，没有丢失任何回答。请排除故障，然后按Enter继续。</translation>
    </message>
    <message>
        <source>%1. Your last entry was not stored. Fix the problem, then enter it again.</source>
        <translation>%1。您最后的录入没有保存。请排除故障，然后重新录入。</translation>
    </message>
    <message>
        <source>Say if needed: “%1”</source>
        <translation>必要时请说：“%1”</translation>
    </message>
    <message>
        <source>Your last entry was stored. After it the head of the log could not be read: %1. Fix the problem, then go on.</source>
        <translation>您最后的录入已经保存。之后无法读取日志摘要：%1。请排除故障，然后继续。</translation>
    </message>
</context>
<context>
    <name>study::app::SessionFooter</name>
    <message>
        <source>Correct</source>
        <translation>更正</translation>
    </message>
    <message>
        <source>Note</source>
        <translation>备注</translation>
    </message>
    <message>
        <source>Flag</source>
        <translation>标记</translation>
    </message>
    <message>
        <source>Void</source>
        <translation>作废</translation>
    </message>
    <message>
        <source>Pause</source>
        <translation>暂停</translation>
    </message>
    <message>
        <source>Stop for now</source>
        <translation>改日继续</translation>
    </message>
    <message>
        <source>Withdrawal</source>
        <translation>退出</translation>
    </message>
    <message>
        <source>%1 (%2)</source>
        <translation>%1 (%2)</translation>
    </message>
    <message>
        <source>Alt %1</source>
        <translation>Alt %1</translation>
    </message>
    <message>
        <source>%1 or %2</source>
        <translation>%1或%2</translation>
    </message>
    <message>
        <source>Last answer  %1</source>
        <translation>最近回答  %1</translation>
    </message>
    <message>
        <source>No answer yet</source>
        <translation>还没有回答</translation>
    </message>
</context>
<context>
    <name>study::app::SessionHeader</name>
    <message>
        <source>Answers stored</source>
        <translation>已保存的回答</translation>
    </message>
    <message>
        <source>NO DISPLAY: rehearsal</source>
        <translation>无触觉屏：预演</translation>
    </message>
    <message>
        <source>Display on: %1 (%2)</source>
        <translation>触觉屏开：%1（%2）</translation>
    </message>
    <message>
        <source>Display on: %1</source>
        <translation>触觉屏开：%1</translation>
    </message>
    <message>
        <source>Display off: %1</source>
        <translation>触觉屏关：%1</translation>
    </message>
    <message>
        <source>REHEARSAL: nothing becomes data</source>
        <translation>预演：不产生任何数据</translation>
    </message>
    <message>
        <source>Participant %1</source>
        <translation>参与者%1</translation>
    </message>
    <message>
        <source>Presentation %1 of %2</source>
        <translation>呈现%1，共%2</translation>
    </message>
    <message>
        <source>Answers %1 of %2</source>
        <translation>回答%1，共%2</translation>
    </message>
    <message>
        <source>About %1 min left</source>
        <translation>约剩%1分钟</translation>
    </message>
    <message>
        <source>This sitting: %1 of %2 min</source>
        <translation>本场次：%1分钟，共%2分钟</translation>
    </message>
    <message>
        <source>Presentations to next break: %1</source>
        <translation>距下次休息的呈现数：%1</translation>
    </message>
</context>
<context>
    <name>study::app::SessionPage</name>
    <message>
        <source>Your text is not stored yet. Store it first, or go on without it.</source>
        <translation>您输入的文本尚未保存。请先保存，或不保存而继续。</translation>
    </message>
    <message>
        <source>Go on without storing</source>
        <translation>不保存并继续</translation>
    </message>
    <message>
        <source>Stay (Esc)</source>
        <translation>留在这里 (Esc)</translation>
    </message>
    <message>
        <source>The participant agreed on their own screen.</source>
        <translation>参与者已在自己的屏幕上表示同意。</translation>
    </message>
    <message>
        <source>The participant does not agree. Speak with them. W ends the session.</source>
        <translation>参与者不同意。请与参与者谈一谈。按W结束实验。</translation>
    </message>
    <message>
        <source>If they agree now, press Enter once more.</source>
        <translation>如果参与者现在同意，请再按一次Enter。</translation>
    </message>
    <message>
        <source>The participant answered on their own screen.</source>
        <translation>参与者已在自己的屏幕上回答。</translation>
    </message>
    <message>
        <source>A scanner typed this, so nothing was stored. Enter the answer by hand.</source>
        <translation>这是扫描器输入的，因此没有保存。请手动录入回答。</translation>
    </message>
    <message>
        <source>The participant has just moved the session on, so your entry did nothing. Enter it again.</source>
        <translation>参与者刚刚自己进入了下一步，所以您的输入没有起作用。请再输入一次。</translation>
    </message>
</context>
<context>
    <name>study::app::SessionRoom</name>
    <message>
        <source>%1. F4 opens the page of the headphones.</source>
        <translation>%1。按F4打开耳机页面。</translation>
    </message>
    <message>
        <source>%1. The pause was not stored, so the session is still open. Fix the problem, or leave once more: no stored answer is lost.</source>
        <translation>%1。暂停没有保存，所以实验仍然开着。请排除问题，或再离开一次：已保存的回答不会丢失。</translation>
    </message>
</context>
<context>
    <name>study::app::SlotCard</name>
    <message>
        <source>%1, %2</source>
        <translation>%1，%2</translation>
    </message>
    <message>
        <source>confirmed ✓</source>
        <translation>已确认 ✓</translation>
    </message>
    <message>
        <source>Slot %1: %2</source>
        <translation>%1格：%2</translation>
    </message>
</context>
<context>
    <name>study::app::StartPage</name>
    <message>
        <source>Study folder</source>
        <translation>研究文件夹</translation>
    </message>
    <message>
        <source>Browse…</source>
        <translation>浏览…</translation>
    </message>
    <message>
        <source>Open the study (Enter)</source>
        <translation>打开研究 (Enter)</translation>
    </message>
    <message>
        <source>Create a new study…</source>
        <translation>新建研究…</translation>
    </message>
    <message>
        <source>Look at a data set…</source>
        <translation>查看数据集…</translation>
    </message>
    <message>
        <source>Data set from photographs…</source>
        <translation>由照片建立数据集…</translation>
    </message>
    <message>
        <source>Display…</source>
        <translation>触觉屏…</translation>
    </message>
    <message>
        <source>Keys and pedals…</source>
        <translation>按键与踏板…</translation>
    </message>
    <message>
        <source>Participant&apos;s screen… (F4)</source>
        <translation>参与者屏幕… (F4)</translation>
    </message>
    <message>
        <source>Vis2Hap</source>
        <translation>Vis2Hap</translation>
    </message>
    <message>
        <source>Blinded studies of how rendered fabrics feel.</source>
        <translation>关于渲染织物手感的盲法研究。</translation>
    </message>
    <message>
        <source>Recent studies</source>
        <translation>最近的研究</translation>
    </message>
    <message>
        <source>Language</source>
        <translation>语言</translation>
    </message>
    <message>
        <source>Language of this window</source>
        <translation>本窗口的语言</translation>
    </message>
    <message>
        <source>translation not reviewed</source>
        <translation>译文未经审校</translation>
    </message>
    <message>
        <source>translation reviewed by %1</source>
        <translation>译文由%1审校</translation>
    </message>
    <message>
        <source>No study yet? Photographs of fabrics become a data set, and a data set becomes a study.</source>
        <translation>还没有研究？织物照片可以做成数据集，数据集可以做成研究。</translation>
    </message>
    <message>
        <source>No folder is given. Type the study folder, or choose it with Browse.</source>
        <translation>没有给出文件夹。请输入研究文件夹，或用“浏览”选择。</translation>
    </message>
    <message>
        <source>Make a protocol…</source>
        <translation>制作实验方案…</translation>
    </message>
    <message>
        <source>Change a protocol…</source>
        <translation>更改实验方案…</translation>
    </message>
    <message>
        <source>the folder that contains study.db, or an address postgresql://USER@HOST/DATABASE?study=NAME</source>
        <translation>包含 study.db 的文件夹，或地址 postgresql://USER@HOST/DATABASE?study=NAME</translation>
    </message>
    <message>
        <source>Watch the study…</source>
        <translation>监视研究…</translation>
    </message>
</context>
<context>
    <name>study::app::StepWork</name>
    <message>
        <source>Stopped. Nothing was written.</source>
        <translation>已停止。没有写入任何内容。</translation>
    </message>
    <message>
        <source>%1: %2 %. Esc stops it.</source>
        <translation>%1：%2%。按Esc停止。</translation>
    </message>
</context>
<context>
    <name>study::app::StudyPage</name>
    <message>
        <source>There is no rehearsal at a station: the images and the codes of the pieces lie on the server. Rehearse in the study&apos;s folder before it moves there.</source>
        <translation>工作站上不能预演：图像和布样编号都在服务器上。请在研究移到服务器之前，在研究的文件夹中预演。</translation>
    </message>
    <message>
        <source>Code of the participant who goes on</source>
        <translation>继续实验的参与者的编号</translation>
    </message>
    <message>
        <source>Continue a session</source>
        <translation>继续一次实验</translation>
    </message>
    <message>
        <source>Code of the next participant</source>
        <translation>下一位参与者的编号</translation>
    </message>
    <message>
        <source>Enrol and begin (Enter)</source>
        <translation>登记并开始 (Enter)</translation>
    </message>
    <message>
        <source>Display…</source>
        <translation>触觉屏…</translation>
    </message>
    <message>
        <source>Keys…</source>
        <translation>按键…</translation>
    </message>
    <message>
        <source>Participant&apos;s screen… (F4)</source>
        <translation>参与者屏幕… (F4)</translation>
    </message>
    <message>
        <source>Close the study (Esc)</source>
        <translation>关闭研究 (Esc)</translation>
    </message>
    <message>
        <source>Tools… (F2)</source>
        <translation>工具… (F2)</translation>
    </message>
    <message>
        <source>Rehearse… (F8)</source>
        <translation>预演… (F8)</translation>
    </message>
    <message>
        <source>Places of the study</source>
        <translation>研究的名额</translation>
    </message>
    <message>
        <source>Place</source>
        <translation>名额</translation>
    </message>
    <message>
        <source>Participant</source>
        <translation>参与者</translation>
    </message>
    <message>
        <source>State</source>
        <translation>状态</translation>
    </message>
    <message>
        <source>Answers</source>
        <translation>回答</translation>
    </message>
    <message>
        <source>Next participant</source>
        <translation>下一位参与者</translation>
    </message>
    <message>
        <source>Type a code, not the name of the person.</source>
        <translation>请输入编号，不要输入真实姓名。</translation>
    </message>
    <message>
        <source>Session in progress</source>
        <translation>进行中的实验</translation>
    </message>
    <message>
        <source>Type the code of the participant who is here.</source>
        <translation>请输入在场参与者的编号。</translation>
    </message>
    <message>
        <source>Finished %1  ·  in progress %2  ·  free %3</source>
        <translation>已完成%1  ·  进行中%2  ·  空闲%3</translation>
    </message>
    <message>
        <source>%1  ·  withdrawn %2</source>
        <translation>%1  ·  已退出%2</translation>
    </message>
    <message>
        <source>No place is free. Places of participants who withdrew wait for the study&apos;s owner, who gives them out: vis2hap server roles ADDRESS --release-held. Then open the study again.</source>
        <translation>没有空闲名额。已退出参与者的名额要等研究的所有者放出：vis2hap server roles ADDRESS --release-held。之后请重新打开研究。</translation>
    </message>
    <message>
        <source>%1 of %2</source>
        <translation>%1，共%2</translation>
    </message>
    <message>
        <source>free</source>
        <translation>空闲</translation>
    </message>
    <message>
        <source>in progress</source>
        <translation>进行中</translation>
    </message>
    <message>
        <source>finished</source>
        <translation>已完成</translation>
    </message>
    <message>
        <source>withdrawn, place freed</source>
        <translation>已退出，名额已空出</translation>
    </message>
    <message>
        <source>withdrawn, waits for the owner</source>
        <translation>已退出，等待所有者处理</translation>
    </message>
    <message>
        <source>%1, scripted</source>
        <translation>%1，脚本</translation>
    </message>
    <message>
        <source>%1, simulated</source>
        <translation>%1，模拟</translation>
    </message>
    <message>
        <source>Continue with %1</source>
        <translation>继续%1的实验</translation>
    </message>
    <message>
        <source>Choose a participant whose session has started but is not finished.</source>
        <translation>请选择一位实验已开始但尚未完成的参与者。</translation>
    </message>
    <message>
        <source>Type %1 to continue with this participant.</source>
        <translation>请输入%1，以继续这位参与者的实验。</translation>
    </message>
    <message>
        <source>%1 is chosen in the list, and %2 is typed. Choose and type the same participant.</source>
        <translation>列表中选择的是%1，输入的是%2。请选择并输入同一位参与者。</translation>
    </message>
    <message>
        <source>Type a code for the next participant, such as %1.</source>
        <translation>请输入下一位参与者的编号，例如%1。</translation>
    </message>
    <message>
        <source>This code %1. Type another code, such as %2.</source>
        <translation>这个编号%1。请输入另一个编号，例如%2。</translation>
    </message>
    <message>
        <source>This code %1. Type at most %2 letters and digits, such as %3.</source>
        <translation>这个编号%1。请输入最多%2个字母和数字，例如%3。</translation>
    </message>
    <message>
        <source>%1 has withdrawn. Type another code.</source>
        <translation>%1已退出。请输入其他编号。</translation>
    </message>
    <message>
        <source>%1 is already enrolled. Choose this participant in the list to continue, or type another code.</source>
        <translation>%1已经登记。请在列表中选择这位参与者以继续，或输入其他编号。</translation>
    </message>
    <message>
        <source>A session is in progress. Press Enter again to enrol %1 as a new participant.</source>
        <translation>有一次实验正在进行。再按一次Enter，可将%1登记为新的参与者。</translation>
    </message>
    <message>
        <source>The study is made. Look at these remarks before the first session:</source>
        <translation>研究已创建。请在第一次实验前查看这些提示：</translation>
    </message>
    <message>
        <source>And %1 more.</source>
        <translation>另有%1条。</translation>
    </message>
</context>
<context>
    <name>study::app::StudySection</name>
    <message>
        <source>Fabrics</source>
        <translation>织物</translation>
    </message>
    <message>
        <source>Choose fabrics of a data set…</source>
        <translation>从数据集中选择织物…</translation>
    </message>
    <message>
        <source>Study</source>
        <translation>研究</translation>
    </message>
    <message>
        <source>Every participant feels each fabric under each condition. The numbers beside show what that takes.</source>
        <translation>每位参与者在每种条件下感受每种织物。旁边的数字显示所需的时间和次数。</translation>
    </message>
    <message>
        <source>Name of the study</source>
        <translation>研究名称</translation>
    </message>
    <message>
        <source>Five words for five fabrics</source>
        <translation>五个词描述五种织物</translation>
    </message>
    <message>
        <source>Participants</source>
        <translation>参与者</translation>
    </message>
    <message>
        <source>Fabrics: a number, which are drawn from the data set, or ids with commas</source>
        <translation>织物：一个数目（从数据集中抽取），或以逗号分隔的标识</translation>
    </message>
    <message>
        <source>5, or F01, F04, F07</source>
        <translation>5，或F01, F04, F07</translation>
    </message>
    <message>
        <source>Fabrics of the data set; Space chooses</source>
        <translation>数据集中的织物；空格键选择</translation>
    </message>
    <message>
        <source>Fabric data set</source>
        <translation>织物数据集</translation>
    </message>
</context>
<context>
    <name>study::app::ToolsPage</name>
    <message>
        <source>Folder for new files</source>
        <translation>新文件的存放文件夹</translation>
    </message>
    <message>
        <source>Browse…</source>
        <translation>浏览…</translation>
    </message>
    <message>
        <source>Live monitor (M)</source>
        <translation>实时监视 (M)</translation>
    </message>
    <message>
        <source>Open what was made (O)</source>
        <translation>打开生成的内容 (O)</translation>
    </message>
    <message>
        <source>Back (Esc)</source>
        <translation>返回 (Esc)</translation>
    </message>
    <message>
        <source>Tools of the study</source>
        <translation>研究工具</translation>
    </message>
    <message>
        <source>Look</source>
        <translation>查看</translation>
    </message>
    <message>
        <source>Status (S)</source>
        <translation>状态 (S)</translation>
    </message>
    <message>
        <source>Verify the study (V)</source>
        <translation>校验研究 (V)</translation>
    </message>
    <message>
        <source>Write into a folder</source>
        <translation>写入文件夹</translation>
    </message>
    <message>
        <source>Each button makes a new file or folder there. Nothing that exists is overwritten.</source>
        <translation>每个按钮都会在那里新建一个文件或文件夹，不会覆盖任何已有内容。</translation>
    </message>
    <message>
        <source>Sheets to print (P)</source>
        <translation>打印单 (P)</translation>
    </message>
    <message>
        <source>Backup (B)</source>
        <translation>备份 (B)</translation>
    </message>
    <message>
        <source>Export (E)</source>
        <translation>导出 (E)</translation>
    </message>
    <message>
        <source>Report (R)</source>
        <translation>报告 (R)</translation>
    </message>
    <message>
        <source>Data sheet (D)</source>
        <translation>数据说明书 (D)</translation>
    </message>
    <message>
        <source>Result</source>
        <translation>结果</translation>
    </message>
    <message>
        <source>Stopped. Nothing was written.</source>
        <translation>已停止。没有写入任何内容。</translation>
    </message>
    <message>
        <source>%1: %2 %</source>
        <translation>%1：%2%</translation>
    </message>
    <message>
        <source>Working… Esc stops long work.</source>
        <translation>正在处理… 按Esc可停止耗时的工作。</translation>
    </message>
    <message>
        <source>The study has faults. Keep it as it is, make a backup, and show the list to its owner.</source>
        <translation>研究有错误。请保持原样，做一份备份，并把清单交给研究负责人。</translation>
    </message>
    <message>
        <source>Written: %1</source>
        <translation>已写入：%1</translation>
    </message>
    <message>
        <source>Done. Nothing was written.</source>
        <translation>完成。没有写入任何内容。</translation>
    </message>
    <message>
        <source>Stop (Esc)</source>
        <translation>停止 (Esc)</translation>
    </message>
    <message>
        <source>Stopping after this step…</source>
        <translation>这一步完成后停止…</translation>
    </message>
    <message>
        <source>No program opens this here. Open it yourself: %1</source>
        <translation>这里没有能打开它的程序。请自行打开：%1</translation>
    </message>
</context>
<context>
    <name>study::app::TouchButton</name>
    <message>
        <source>Stamp the first touch (T)</source>
        <translation>记录首次触摸 (T)</translation>
    </message>
    <message>
        <source>Alt T</source>
        <translation>Alt T</translation>
    </message>
    <message>
        <source>T</source>
        <translation>T</translation>
    </message>
    <message>
        <source>%1 or %2</source>
        <translation>%1或%2</translation>
    </message>
    <message>
        <source>The display reports the first touch (or press %1)</source>
        <translation>首次触摸由触觉屏报告 (或按%1)</translation>
    </message>
    <message>
        <source>Stamp the first touch (%1)</source>
        <translation>记录首次触摸 (%1)</translation>
    </message>
    <message>
        <source>The display reported the first touch ✓</source>
        <translation>触觉屏已报告首次触摸 ✓</translation>
    </message>
    <message>
        <source>You stamped the first touch ✓</source>
        <translation>您已记录首次触摸 ✓</translation>
    </message>
</context>
<context>
    <name>study::app::TrayPage</name>
    <message>
        <source>Code of the next piece</source>
        <translation>下一块布样的编码</translation>
    </message>
    <message>
        <source>The tray is ready (Enter)</source>
        <translation>托盘已就绪 (Enter)</translation>
    </message>
    <message>
        <source>The tray is ready</source>
        <translation>托盘已就绪</translation>
    </message>
    <message>
        <source>stays</source>
        <translation>留下</translation>
    </message>
    <message>
        <source>put here</source>
        <translation>放在这里</translation>
    </message>
    <message>
        <source>from %1</source>
        <translation>来自%1格</translation>
    </message>
    <message>
        <source>Presentation %1</source>
        <translation>呈现%1</translation>
    </message>
    <message>
        <source>%1 is not the piece of slot %2. It must be %3.</source>
        <translation>%1不是%2格的布样，应为%3。</translation>
    </message>
    <message>
        <source>All pieces are confirmed.</source>
        <translation>所有布样均已确认。</translation>
    </message>
    <message>
        <source>Scan or type the piece in slot %1</source>
        <translation>请扫描或输入%1格的布样</translation>
    </message>
    <message>
        <source>No question is asked yet, so this key is no answer. Look at the tray, then press Enter twice.</source>
        <translation>还没有提问，所以这次按键不是回答。请检查托盘，然后按两次Enter。</translation>
    </message>
    <message>
        <source>Press Enter once more to confirm the tray.</source>
        <translation>再按一次Enter以确认托盘。</translation>
    </message>
</context>
<context>
    <name>study::app::WordsControls</name>
    <message>
        <source>Answer of the participant in words</source>
        <translation>参与者用文字表述的回答</translation>
    </message>
    <message>
        <source>The answer is empty. Press Enter again to store an answer without words.</source>
        <translation>回答是空的。再按一次Enter，可保存没有文字的回答。</translation>
    </message>
    <message>
        <source>Write the words of the participant. Press Shift and Enter for a new line.</source>
        <translation>请写下参与者的原话。按Shift和Enter换行。</translation>
    </message>
</context>
<context>
    <name>study::app::appearanceHint</name>
    <message>
        <source>Smaller text (Ctrl −)</source>
        <translation>缩小文字 (Ctrl −)</translation>
    </message>
    <message>
        <source>Larger text (Ctrl +)</source>
        <translation>放大文字 (Ctrl +)</translation>
    </message>
    <message>
        <source>Light, dark or high contrast (Ctrl D)</source>
        <translation>浅色、深色或高对比度 (Ctrl D)</translation>
    </message>
</context>
<context>
    <name>study::making::SheetText</name>
    <message>
        <source>All participants</source>
        <translation>全部参与者</translation>
    </message>
    <message>
        <source>Place %1</source>
        <translation>名额%1</translation>
    </message>
    <message>
        <source>en</source>
        <comment>language of the sheets</comment>
        <translation>zh</translation>
    </message>
    <message>
        <source>1 entry</source>
        <translation>1条记录</translation>
    </message>
    <message>
        <source>%1 entries</source>
        <translation>%1条记录</translation>
    </message>
    <message>
        <source>Cut out the labels. Fix each label to the back of its piece, as the preparation sheet shows.</source>
        <translation>请剪下标签。按照准备单，把每张标签贴在对应布样的背面。</translation>
    </message>
    <message>
        <source>The line on a label is below the code, so that nobody reads 199 as 661.</source>
        <translation>标签上的横线在编码下方，以免把199读成661。</translation>
    </message>
    <message>
        <source>%1: labels of the fabric pieces</source>
        <translation>%1：布样标签</translation>
    </message>
    <message>
        <source>For the person who labels the pieces. The operator of a session only needs the codes.</source>
        <translation>供贴标签的人使用。实验主试只需要编码。</translation>
    </message>
    <message>
        <source>code</source>
        <translation>编码</translation>
    </message>
    <message>
        <source>fabric</source>
        <translation>织物</translation>
    </message>
    <message>
        <source>id</source>
        <translation>标识</translation>
    </message>
    <message>
        <source>You also need sandpaper, silk and a second piece of one fabric, for the two ends of the scale.</source>
        <translation>另外还需要砂纸、丝绸以及某种织物的第二块布样，用来说明量表的两端。</translation>
    </message>
    <message>
        <source>%1: preparation of the fabric pieces</source>
        <translation>%1：布样准备单</translation>
    </message>
    <message>
        <source>At the end of a sitting the app shows the head of the log. Copy it here: the number, the colon and the 16 digits. Keep this sheet away from the computer. It then shows later whether the log was cut, put back or written anew.</source>
        <translation>每个场次结束时，程序会显示日志摘要。请抄在这里：数字、冒号和16位字符。请把这张单子放在远离计算机的地方。以后就能据此查出日志是否被删减、回退或重写。</translation>
    </message>
    <message>
        <source>date</source>
        <translation>日期</translation>
    </message>
    <message>
        <source>participant</source>
        <translation>参与者</translation>
    </message>
    <message>
        <source>operator</source>
        <translation>主试</translation>
    </message>
    <message>
        <source>head of the log</source>
        <translation>日志摘要</translation>
    </message>
    <message>
        <source>%1: sittings</source>
        <translation>%1：场次记录</translation>
    </message>
    <message>
        <source>The app shows each sentence at the beginning of its block. Read it aloud.</source>
        <translation>程序会在每个组块开始时显示相应的句子。请朗读。</translation>
    </message>
    <message>
        <source>questions</source>
        <translation>问题</translation>
    </message>
    <message>
        <source>instruction</source>
        <translation>指导语</translation>
    </message>
    <message>
        <source>sentence</source>
        <translation>句子</translation>
    </message>
    <message>
        <source>Order</source>
        <translation>顺序</translation>
    </message>
    <message>
        <source>place</source>
        <translation>名额</translation>
    </message>
    <message>
        <source>instructions</source>
        <translation>指导语</translation>
    </message>
    <message>
        <source>%1: instructions of the blocks</source>
        <translation>%1：各组块的指导语</translation>
    </message>
    <message>
        <source>Head of the log when this page was made: %1 (%2). Check: %3</source>
        <translation>制作本页时的日志摘要：%1（%2）。校验：%3</translation>
    </message>
    <message>
        <source>Fabrics for familiarisation with the display: %1.</source>
        <translation>用于熟悉触觉屏的织物：%1。</translation>
    </message>
    <message>
        <source>, </source>
        <comment>between the names of a list</comment>
        <translation>、</translation>
    </message>
    <message>
        <source>You also need the materials for the two ends of the scale. The usual ones are sandpaper, silk and a second piece of one fabric. Your study&apos;s own texts may name others.</source>
        <translation>还需要量表两端所用的材料，通常是砂纸、丝绸和一种布料的第二块样品。本研究自己的文字可能指定其他材料。</translation>
    </message>
</context>
</TS>

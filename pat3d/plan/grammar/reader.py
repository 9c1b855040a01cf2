"""Reads the chunks of a prompt into a draft: who is on, in or beside whom."""

from __future__ import annotations

from collections.abc import Sequence

from pat3d.plan.grammar import lexicon
from pat3d.plan.grammar.chunks import Chunk
from pat3d.plan.grammar.clauses import lists_on, names_second, precedes_phrase, starts_clause
from pat3d.plan.grammar.context import Context
from pat3d.plan.grammar.draft import Draft, Flank, Group
from pat3d.plan.grammar.formations import Formations
from pat3d.plan.grammar.groups import GroupMaker, recolour
from pat3d.plan.grammar.headless import describe_owner, members_told
from pat3d.plan.grammar.links import Link
from pat3d.plan.grammar.members import REST, position
from pat3d.plan.grammar.modifiers import NO_MODIFIERS
from pat3d.plan.grammar.phrases import Phrase
from pat3d.plan.grammar.relations import Frame
from pat3d.plan.grammar.sides import Sides
from pat3d.scene.model import SUPPORT_KINDS


class Reader:
    """Walks through the chunks of one prompt."""

    def __init__(self, draft: Draft, maker: GroupMaker) -> None:
        self._now = Context(draft=draft, maker=maker)
        self._chunks: Sequence[Chunk] = ()
        self._all = False
        """The subject is everything read so far ("The items are placed on ...")."""
        self._verb = False
        """A verb stands directly before."""
        self._had_verb = False
        """The clause has its verb."""
        self._each = False
        self._relative = False
        """A relative pronoun stands before the verb: what was read last is its subject."""
        self._side = ""
        self._which: Group | None = None
        """What "to the left of which" was last said of."""
        self._formations = Formations(self._now)
        self._sides = Sides(self._now)

    def read(self, chunks: Sequence[Chunk]) -> None:
        """Read all chunks."""
        self._chunks = chunks
        at = 0
        while at < len(chunks):
            at = self._step(at)

    def _step(self, at: int) -> int:
        piece = self._chunks[at]
        if piece.kind in ("stop", "clause"):
            self._end_clause()
            if piece.kind == "stop":
                self._now.sentence += 1
                self._now.maker.end_statement()
        elif piece.kind in ("comma", "and", "dash"):
            if self._now.related and not self._now.top:
                self._now.maker.end_relation()
            joined = {piece.kind, self._now.mark} == {"and", "comma"}
            self._now.mark = self._now.mark if self._now.mark == "start" else "comma and" if joined else piece.kind
            return at + 1
        elif piece.kind == "aside":
            self._now.draft.set_aside.append(piece.text)
        elif piece.kind == "there":
            self._there()
        elif piece.kind == "verb":
            self._on_verb()
        elif piece.kind == "quality":
            self._qualify(piece)
        elif piece.kind == "arrange":
            self._formations.arrange(piece, self._chunks[at + 1], verb=self._verb)
        elif piece.kind == "each":
            self._on_each(at)
        elif piece.kind == "side":
            self._on_side(piece, at)
        elif piece.kind == "link" and piece.link is not None:
            return self._on_link(piece.link, at)
        elif piece.phrase is not None:
            self._on_phrase(piece.phrase, at)
        if piece.kind not in ("stop", "clause"):
            self._now.mark = ""
        return at + 1

    def _end_clause(self) -> None:
        self._formations.end_clause()
        self._now.close()
        self._now.maker.end_sentence()
        self._verb = self._had_verb = self._all = self._each = False
        self._sides.end_clause()
        self._now.mark = "start"

    def _there(self) -> None:
        waiting = any(not frame.link.inverse for frame in self._now.frames)
        if not waiting and self._now.subject:
            self._now.before = self._now.subject
        self._now.wait_for_child()
        self._now.subject, self._now.top, self._had_verb, self._verb = [], [], True, False
        self._now.listed = []

    def _on_verb(self) -> None:
        self._now.maker.end_sentence()
        self._now.wait_for_child()
        self._verb = self._had_verb = True

    def _qualify(self, piece: Chunk) -> None:
        if self._now.subject:
            for group in self._now.subject:
                recolour(group, piece.modifiers)
        else:
            self._now.draft.set_aside.append(piece.text)

    def _on_each(self, at: int) -> None:
        follower = self._chunks[at + 1] if at + 1 < len(self._chunks) else None
        before = self._chunks[at - 1] if at else None
        if follower is not None and follower.kind == "link":
            self._each = True
            return
        if before is not None and before.kind == "phrase":
            for group in self._now.last:
                frame = self._now.holder.get(id(group))
                if frame is not None and frame.parents:
                    self._now.maker.multiply(group, frame.parents[0].count)

    def _on_phrase(self, phrase: Phrase, at: int) -> None:
        if phrase.head == "which":
            self._relative = True
            return
        if phrase.kind == "pronoun" or (
            phrase.kind == "part" and phrase.possessive and starts_clause(self._chunks, at)
        ):
            if self._now.mark == "start" or not self._now.subject:
                self._now.subject = self._now.last = list(self._now.before)
            return
        if phrase.kind == "items":
            if starts_clause(self._chunks, at) or self._now.mark == "start":
                self._now.subject, self._now.last, self._all = [], [], True
            self._now.draft.set_aside.append(phrase.words)
            return
        if phrase.kind == "pieces" and not phrase.said and (told := members_told(self._now, self._chunks, at)):
            self._begin_list(told)
            return
        if phrase.kind in ("part", "pieces"):
            describe_owner(self._now, phrase)
            return
        if phrase.kind == "background":
            self._background(phrase, at)
            return
        group, known = self._group(phrase)
        if group is None:
            return
        self._all = False
        self._formations.read.append(group)
        self._now.more = lists_on(self._chunks, at + 1)
        if (
            self._had_verb
            and self._now.mark in ("and", "comma and", "comma", "dash")
            and starts_clause(self._chunks, at)
        ):
            self._end_clause()
        if self._now.frames and self._now.frames[-1].fresh and self._now.mark in ("", "comma", "start"):
            self._now.enlist(self._now.frames[-1], group, known)
        elif self._now.mark in ("comma", "and", "comma and", "dash") and (frame := self._now.open_frame(group, phrase)):
            self._now.enlist(frame, group, known)
        else:
            if self._now.mark == "start" or (self._verb and not self._now.subject):
                self._now.subject = []
            self._now.frames = []
            if not self._had_verb or not self._now.subject:
                self._now.subject = [*self._now.subject, group]
            self._now.top.append(group)
            self._now.listed.append(group)
            self._now.top_joined = "and" in self._now.mark
        if self._now.frames and not self._now.frames[-1].link.inverse and group in self._now.frames[-1].members:
            self._now.subject = [*self._now.subject, group]
        self._verb = False
        self._now.last = [group]
        self._sides.follow(group)

    def _begin_list(self, group: Group) -> None:
        """What follows is said of `group`."""
        self._now.frames = []
        self._now.subject, self._now.top, self._now.listed, self._now.last = [group], [group], [group], [group]
        self._formations.read.append(group)

    def _group(self, phrase: Phrase, besides: Sequence[Group] = ()) -> tuple[Group | None, bool]:
        """The group that `phrase`, said of `besides`, means, and whether it was known before."""
        known = self._now.maker.refer(phrase, besides=besides)
        if known is not None:
            known.modifiers = known.modifiers.marked_as(phrase.modifiers)
            return known, True
        frame = self._now.frames[-1] if self._now.frames else None
        return self._now.maker.make(phrase, filling=bool(frame and frame.fresh and frame.link.filling)), False

    def _on_side(self, piece: Chunk, at: int) -> None:
        """Read "on the left": of the clause's next phrase when it comes first, else of what was read last."""
        kinds = [each.kind for each in self._chunks[at + 1 : at + 3]]
        coming = kinds[:1] in (["there"], ["verb"]) or (
            kinds in (["comma", "there"], ["comma", "phrase"]) and self._now.mark == "start"
        )
        if self._now.mark == "start" or (self._now.mark and (coming or kinds[:1] == ["phrase"])):
            if self._now.mark != "start":
                self._end_clause()
            self._sides.lead(piece.text)
        else:
            self._sides.trail(piece.text, self._now.subject if self._verb else self._now.last)
            self._verb = False

    def _background(self, phrase: Phrase, at: int) -> None:
        self._now.draft.set_aside.append(phrase.words)
        if phrase.substance:
            self._now.draft.notes.append(f'"{phrase.words}" is no rigid body and is left out.')
        if self._now.frames and self._now.frames[-1].fresh:
            self._now.frames[-1].fresh = False
            return
        if self._now.mark == "start" or starts_clause(self._chunks, at):
            self._now.close()

    def _on_link(self, link: Link, at: int) -> int:
        if link.finite:
            self._now.frames = []
            self._now.maker.end_sentence()
            self._had_verb = True
        follower = self._chunks[at + 1] if at + 1 < len(self._chunks) else None
        apart = link.finite or self._verb or "comma" in self._now.mark or self._now.mark == "dash"
        if self._relative:
            apart, self._relative = False, False
            near = self._now.last[-1:] or self._now.subject
            self._now.top = []
        else:
            near = self._now.subject if apart else self._now.last or self._now.subject
        if link.manner == "include":
            near = self._now.last or self._now.subject
        elif self._now.mark in ("and", "comma and") and not link.inverse and not self._verb:
            near = self._now.related or near
        if link.inverse:
            self._open(link, near)
            self._verb, self._now.mark = False, ""
            return at + 1
        target = follower.phrase if follower is not None and follower.kind == "phrase" else None
        if follower is not None and follower.kind == "each":
            target = Phrase(kind="pronoun", head="each", each=True)
        if target is None and self._now.mark and precedes_phrase(self._chunks, at):
            self._end_clause()
            self._sides.lead_with(link)
            self._now.mark = ""
            return at + 1
        if target is None:
            self._sides.without_landmark(link)
            self._verb, self._now.mark = False, ""
            return at + 1
        if target.head == "which" and near:
            # "A mug behind which is a bottle".
            self._which = self._which if self._which and "and" in self._now.mark else near[-1]
            self._now.open_beside(link, self._which)
            self._verb, self._now.mark = False, ""
            return at + 2
        fronted = self._fronted(at, near)
        self._now.second = names_second(self._chunks, at + 2)
        self._now.more = lists_on(self._chunks, at + 2)
        if fronted and self._now.subject:
            inside = self._now.mark != "start" and target.head in ("it", "its", "itself")
            self._now.close()
            # "a bowl, a book, and next to it a pen": the pen is next to the book.
            self._now.before = self._now.begun()[-1:] if inside else self._now.before
        self._forward(link, target, [] if fronted else near, apart=apart)
        self._verb, self._now.mark = False, ""
        return at + 2

    def _fronted(self, at: int, near: list[Group]) -> bool:
        """Whether the relation at chunk `at` speaks of a phrase that is still to come."""
        if self._all:
            return False
        kinds = [piece.kind for piece in self._chunks[at + 2 : at + 5]]
        if self._now.mark == "start" or not near:
            return True
        if not self._now.mark:
            return False
        inserted = "and" in self._now.mark and kinds[:2] == ["comma", "phrase"]
        return inserted or kinds[:1] in (["there"], ["phrase"]) or kinds[:2] in (["comma", "there"], ["verb", "phrase"])

    def _open(self, link: Link, parents: list[Group]) -> None:
        if link.manner == "include" and parents and parents[-1].cycle and not parents[-1].replaced:
            self._now.replace_generic(parents[-1])
            return
        if not parents:
            return
        content = self._now.holder.get(id(parents[-1]))
        if link.manner == "with" and content and content.link.manner in ("of", "hold") and parents[-1].count > 1:
            parents = content.parents or parents
        if link.manner == "include" and (holder := self._now.holder.get(id(parents[-1]))):
            holder.fresh, holder.closed = True, False
            return
        parents = parents[-1:] if not self._each else parents
        flank = None
        if link.manner == "flank":
            flank = Flank(parent=parents[0])
            self._now.draft.flanks.append(flank)
        if link.finite or link.manner != "of":
            self._now.frames = [
                frame for frame in self._now.frames if any(m in parents for m in frame.members) or not link.finite
            ]
        self._now.frames.append(Frame(link=link, parents=parents, flank=flank, each=self._each))
        self._each = False

    def _forward(self, link: Link, phrase: Phrase, children: list[Group], *, apart: bool) -> None:
        if link.manner == "half" and phrase.kind == "background":
            self._now.on_half(children, link.side or "centre", None)
        told_apart = phrase.modifiers.colours or phrase.modifiers.size_word or position(phrase)
        one = phrase.kind == "pieces" and not phrase.said and (told_apart or phrase.head in REST)
        if one and (told := self._now.maker.members.told(phrase, self._now.draft.groups[::-1])):
            self._join(link, [told], phrase, children, known=True, apart=apart)
            return
        if phrase.kind in ("background", "part", "pieces", "items"):
            self._to_place(phrase, children, link)
            return
        if phrase.kind == "pronoun":
            parents, known = self._now.antecedent(children, phrase, link.kind or ""), True
        else:
            group, known = self._group(phrase, children)
            parents = [group] if group is not None else []
        if parents:
            self._join(link, parents, phrase, children, known=known, apart=apart)

    def _join(
        self, link: Link, parents: list[Group], phrase: Phrase, children: list[Group], *, known: bool, apart: bool
    ) -> None:
        """Relate `children` to the first of `parents`, which `phrase` speaks of."""
        parent = parents[0]
        if phrase.part in lexicon.DRAWERS:
            self._now.draft.notes.append(f'"{phrase.words}": "{parent.said}" has no parts of its own and is meant.')
        if self._all:
            if link.kind in SUPPORT_KINDS:
                self._now.carry_all(link, parent)
                self._all = False
            return
        if not children:
            frame = Frame(link=link, parents=parents, each=phrase.each)
            self._now.frames = [frame]
            self._now.last = [] if known and phrase.kind == "pronoun" else parents
            return
        if not apart and phrase.head not in lexicon.DEMONSTRATIVES:
            children = self._now.climb(children, link, parent)
        if link.kind in ("on", "in") and link.manner == "place" and phrase.kind == "object":
            children = self._now.list_on(children, parent)
        if link.kind in SUPPORT_KINDS and phrase.kind == "pronoun":
            children = self._now.list_of(children, parent)
        self._now.related = children
        if link.manner == "sides" and len(children) > 1:
            self._now.draft.flanks.append(Flank(parent=parent, members=children))
            children = []
        if self._each and not known and parent.count == 1 and len(children) > 0:
            self._now.maker.multiply(parent, sum(child.count for child in children))
            parents = [self._now.maker.members.pick(parent, child.count, NO_MODIFIERS) for child in children]
        self._each = False
        carriers = parents if len(parents) == len(children) else [parent] * len(children)
        for child, parent in zip(children, carriers, strict=True):
            if phrase.each and parent.count > 1:
                self._now.maker.multiply(child, parent.count)
                self._now.shared_out.add(id(child))
            if child is not parent or phrase.kind == "object":
                self._now.relate(child, self._sides.claimed(child, link), parent)
                self._now.carried[id(parent)] = [child]
        self._now.top = []
        self._now.last = parents
        if phrase.kind == "pronoun":
            self._now.last = children

    def _to_place(self, phrase: Phrase, children: list[Group], link: Link) -> None:
        """A relation to the floor, a part or the items in general."""
        if phrase.kind == "background":
            self._now.draft.set_aside.append(phrase.words)
            if children:
                self._now.last = []
                self._now.top = []
            else:
                self._now.frames = []
            return
        if phrase.kind in ("part", "pieces"):
            owners = self._now.antecedent(children, phrase)
            if children and owners and link.kind is not None:
                for child in children:
                    self._now.relate(child, link, owners[0])
            elif owners:
                self._now.frames = [Frame(link=link, parents=owners)]
            return
        self._now.draft.set_aside.append(phrase.words)

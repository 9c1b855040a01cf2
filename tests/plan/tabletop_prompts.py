"""Prompts as the makers of manipulation scenes write them, with the plan that a person reads in them.

Written by hand, like tests.plan.prompts: tabletops and kitchens, stacks, sides, counts, rows, members told of one by
one, sentences with "then", the passive voice and fragments.
"""

from __future__ import annotations

from tests.plan.prompts import expect, same


def coloured(noun: str, *colours: str) -> dict[str, str]:
    return {f"{colour} {noun}": noun for colour in colours}


TABLETOP_PROMPTS = (
    # A place without a landmark
    expect(
        "a red block on a blue block on a green block, and a yellow block to the right",
        coloured("block", "red", "blue", "green", "yellow"),
        "red block on blue block", "blue block on green block", "yellow block right_of green block",
    ),
    expect(
        "A fork to the left of a plate and a knife and a spoon to its right.",
        same("fork", "plate", "knife", "spoon"),
        "fork left_of plate", "knife right_of plate", "spoon right_of plate",
    ),
    expect(
        "A mug on the left and a bowl on the right of a teapot.",
        same("mug", "bowl", "teapot"),
        "mug left_of teapot", "bowl right_of teapot",
    ),
    expect(
        "A mug on the left and a bowl on the right of a table.",
        same("mug", "bowl", "table"),
        "mug on table", "bowl on table", "mug left_of bowl",
    ),
    expect(
        "a knife, fork, and spoon to the right of a plate and a napkin to the left",
        same("knife", "fork", "spoon", "plate", "napkin"),
        "knife right_of plate", "fork right_of plate", "spoon right_of plate", "napkin left_of plate",
    ),
    expect(
        "A fork on the left of the plate, a knife on the right.",
        same("fork", "plate", "knife"),
        "fork left_of plate", "knife right_of plate",
    ),
    expect(
        "A fork is to the left of the plate. A knife is to the right.",
        same("fork", "plate", "knife"),
        "fork left_of plate", "knife right_of plate",
    ),
    expect(
        "A bottle on top of a desk, a bowl on a plate, and a crate to the right.",
        same("bottle", "desk", "bowl", "plate", "crate"),
        "bottle on desk", "bowl on plate", "crate on desk", "crate right_of bottle",
    ),
    expect(
        "A mug, a spoon on the left and a napkin on the right",
        same("mug", "spoon", "napkin"),
        "spoon left_of mug", "napkin right_of mug", "spoon left_of napkin",
    ),
    expect(
        "A pot with a spoon in it, and a bowl nearby.",
        same("pot", "spoon", "bowl"),
        "spoon in pot", "bowl next_to pot",
    ),
    expect(
        "A desk with a lamp and a mug nearby",
        same("desk", "lamp", "mug"),
        "lamp on desk", "mug on desk", "mug next_to lamp",
    ),
    expect(
        "A toy sailboat in front, a teddy bear behind.",
        same("toy sailboat", "teddy bear"),
        "teddy bear behind toy sailboat",
    ),
    expect(
        "A tower of three blocks. A ball is to the left.",
        same("block 1", "block 2", "block 3", "ball"),
        "block 2 on block 1", "block 3 on block 2", "ball left_of block 1",
    ),
    expect(
        "A tall bottle, behind it a mug, and in front of it a bowl.",
        same("bottle", "mug", "bowl"),
        "mug behind bottle", "bowl in_front_of bottle",
    ),
    expect(
        "Behind a row of three jars there is a stack of two boxes, and in front there is a ball.",
        same("jar 1", "jar 2", "jar 3", "box 1", "box 2", "ball"),
        "jar 1 left_of jar 2", "jar 2 left_of jar 3", "box 2 on box 1",
        *(f"{each} jar {at}" for each in ("box 1 behind", "ball in_front_of") for at in (1, 2, 3)),
    ),
    expect(
        "On a desk, a radio in the middle, a mug to its right and a bowl to its left.",
        same("desk", "radio", "mug", "bowl"),
        "radio on desk", "mug on desk", "bowl on desk", "radio left_of mug", "radio right_of bowl",
        "mug right_of bowl",
    ),
    expect(
        "A blue block on the left, a red block in the middle and a pink block on the right.",
        coloured("block", "blue", "red", "pink"),
        "blue block left_of red block", "blue block left_of pink block", "red block left_of pink block",
    ),
    expect(
        "A vase on the far left of a shelf and a radio on the far right.",
        same("vase", "shelf", "radio"),
        "vase on shelf", "radio on shelf", "vase left_of radio",
    ),
    expect(
        "A mug is to the left of the bowl, which is to the left of the plate.",
        same("mug", "bowl", "plate"),
        "mug left_of bowl", "bowl left_of plate",
    ),
    expect(
        "Knife and fork on either side of a plate.",
        same("knife", "fork", "plate"),
        "knife left_of plate", "fork right_of plate",
    ),
    expect(
        "Two plates side by side with a fork between them.",
        same("plate 1", "plate 2", "fork"),
        "plate 1 left_of plate 2", "plate 1 left_of fork", "plate 2 right_of fork",
    ),
    # Stacks and towers
    expect(
        "Place three plates in a stack, then put a cup on top.",
        same("plate 1", "plate 2", "plate 3", "cup"),
        "plate 2 on plate 1", "plate 3 on plate 2", "cup on plate 3",
    ),
    expect(
        "Stack three bowls on a tray.",
        same("bowl 1", "bowl 2", "bowl 3", "tray"),
        "bowl 1 on tray", "bowl 2 on bowl 1", "bowl 3 on bowl 2",
    ),
    expect(
        "Stack a plate, a bowl and a cup on a tray.",
        same("plate", "bowl", "cup", "tray"),
        "plate on tray", "bowl on plate", "cup on bowl",
    ),
    expect("Stack the red block on the blue block.", coloured("block", "red", "blue")),
    expect(
        "A tower of a red, a green and a blue block.",
        coloured("block", "red", "green", "blue"),
        "green block on red block", "blue block on green block",
    ),
    expect(
        "A tower made of three blocks.",
        same("block 1", "block 2", "block 3"),
        "block 2 on block 1", "block 3 on block 2",
    ),
    expect(
        "A stack of two red and three blue blocks.",
        {**dict.fromkeys(("red block 1", "red block 2"), "block"), **{f"blue block {i}": "block" for i in (1, 2, 3)}},
        "red block 2 on red block 1", "blue block 1 on red block 2", "blue block 2 on blue block 1",
        "blue block 3 on blue block 2",
    ),
    expect(
        "Six cups in two stacks on a table.",
        same(*(f"cup {i}" for i in range(1, 7)), "table"),
        "cup 1 on table", "cup 4 on table", "cup 2 on cup 1", "cup 3 on cup 2", "cup 5 on cup 4", "cup 6 on cup 5",
    ),
    expect(
        "A red block with a green block on top and a blue block on top of that.",
        coloured("block", "red", "green", "blue"),
        "green block on red block", "blue block on green block",
    ),
    expect(
        "A bowl stacked on a plate stacked on a tray.",
        same("bowl", "plate", "tray"),
        "bowl on plate", "plate on tray",
    ),
    # Rows, rings, heaps
    expect(
        "Six cups in two rows.",
        same(*(f"cup {i}" for i in range(1, 7))),
        "cup 1 left_of cup 2", "cup 2 left_of cup 3", "cup 4 left_of cup 5", "cup 5 left_of cup 6",
        "cup 4 behind cup 1", "cup 5 behind cup 2", "cup 6 behind cup 3",
    ),
    expect(
        "A 2x2 grid of blocks.",
        same("block 1", "block 2", "block 3", "block 4"),
        "block 1 left_of block 2", "block 3 left_of block 4", "block 3 behind block 1", "block 4 behind block 2",
    ),
    expect(
        "From left to right: a mug, a bowl, and a plate.",
        same("mug", "bowl", "plate"),
        "mug left_of bowl", "bowl left_of plate",
    ),
    expect(
        "On a table, from right to left: a mug and a bowl.",
        same("table", "mug", "bowl"),
        "mug on table", "bowl on table", "bowl left_of mug",
    ),
    expect(
        "A red, a green and a blue block in a row.",
        coloured("block", "red", "green", "blue"),
        "red block left_of green block", "green block left_of blue block",
    ),
    expect(
        "Four cups arranged in a circle around a teapot.",
        same("cup 1", "cup 2", "cup 3", "cup 4", "teapot"),
        *(f"cup {i} around teapot" for i in (1, 2, 3, 4)),
    ),
    expect(
        "A ring of three cups around a teapot",
        same("cup 1", "cup 2", "cup 3", "teapot"),
        *(f"cup {i} around teapot" for i in (1, 2, 3)),
    ),
    expect(
        "A pile of apples in a crate.",
        same("apple 1", "apple 2", "apple 3", "apple 4", "crate"),
        *(f"apple {i} in crate" for i in (1, 2, 3, 4)),
    ),
    expect(
        "A pile of toys in a basket.",
        same("ball", "block", "rubber duck", "teddy bear", "basket"),
        "ball in basket", "block in basket", "rubber duck in basket", "teddy bear in basket",
    ),
    expect(
        "A heap of three oranges on a table",
        same("orange 1", "orange 2", "orange 3", "table"),
        "orange 1 on table", "orange 2 on table", "orange 3 on table", "orange 2 next_to orange 1",
        "orange 3 next_to orange 2",
    ),
    # Members of a group
    expect(
        "Two mugs, one on a plate and the other on a tray.",
        same("mug 1", "mug 2", "plate", "tray"),
        "mug 1 on plate", "mug 2 on tray",
    ),
    expect(
        "Two mugs, a red one on a plate and a blue one on a tray.",
        {**coloured("mug", "red", "blue"), **same("plate", "tray")},
        "red mug on plate", "blue mug on tray",
    ),
    expect(
        "Two mugs: one red, one blue. The red mug is on a book.",
        {**coloured("mug", "red", "blue"), "book": "book"},
        "red mug on book",
    ),
    expect(
        "Three blocks, the red one on the green one and the blue one next to them.",
        coloured("block", "red", "green", "blue"),
        "red block on green block", "blue block next_to green block",
    ),
    expect(
        "Four mugs, two on the left of a radio and two on the right.",
        same("mug 1", "mug 2", "mug 3", "mug 4", "radio"),
        "mug 1 left_of radio", "mug 2 left_of radio", "mug 3 right_of radio", "mug 4 right_of radio",
    ),
    expect(
        "Five balls, three in a box and the rest in a basket.",
        same(*(f"ball {i}" for i in range(1, 6)), "box", "basket"),
        *(f"ball {i} in box" for i in (1, 2, 3)), "ball 4 in basket", "ball 5 in basket",
    ),
    expect(
        "Two boxes on the floor, with a ball in the left box and a block in the right box.",
        same("box 1", "box 2", "ball", "block"),
        "box 1 left_of box 2", "ball in box 1", "block in box 2",
    ),
    expect(
        "A mug on the left plate and a bowl on the right plate.",
        same("mug", "plate 1", "bowl", "plate 2"),
        "mug on plate 1", "bowl on plate 2", "plate 2 right_of plate 1",
    ),
    expect(
        "Five books on a shelf, two of them red.",
        {"red book 1": "book", "red book 2": "book", **same("book 1", "book 2", "book 3", "shelf")},
        "red book 1 on shelf", "red book 2 on shelf", "book 1 on shelf", "book 2 on shelf", "book 3 on shelf",
    ),
    expect(
        "A block on each of two plates.",
        same("block 1", "block 2", "plate 1", "plate 2"),
        "block 1 on plate 1", "block 2 on plate 2",
    ),
    expect("A ball on one of two boxes.", same("ball", "box 1", "box 2"), "ball on box 1"),
    expect(
        "A radio and two mugs, one on each side of it.",
        same("radio", "mug 1", "mug 2"),
        "mug 1 left_of radio", "mug 2 right_of radio",
    ),
    expect(
        "A red mug and a blue one on a tray.",
        {**coloured("mug", "red", "blue"), "tray": "tray"},
        "red mug on tray", "blue mug on tray",
    ),
    expect(
        "A small and a large bowl on a table.",
        {"small bowl": "bowl", "large bowl": "bowl", "table": "table"},
        "small bowl on table", "large bowl on table",
    ),
    expect(
        "Two plates: the left one with an apple and the right one with a pear.",
        same("plate 1", "plate 2", "apple", "pear"),
        "apple on plate 1", "pear on plate 2", "plate 1 left_of plate 2",
    ),
    expect(
        "Three mugs in a row; the middle one is red.",
        {"red mug": "mug", **same("mug 1", "mug 2")},
        "mug 1 left_of red mug", "red mug left_of mug 2",
    ),
    expect(
        "Two bowls, the smaller one inside the larger one.",
        {"smaller bowl": "bowl", "larger bowl": "bowl"},
        "smaller bowl in larger bowl",
    ),
    expect(
        "A red, a blue and a green mug, each on its own plate.",
        {**coloured("mug", "red", "blue", "green"), **same("plate 1", "plate 2", "plate 3")},
        "red mug on plate 1", "blue mug on plate 2", "green mug on plate 3",
    ),
    expect(
        "Three plates, a fork to the left of each and a knife to the right of each.",
        same(*(f"{noun} {i}" for noun in ("plate", "fork", "knife") for i in (1, 2, 3))),
        *(f"fork {i} left_of plate {i}" for i in (1, 2, 3)), *(f"knife {i} right_of plate {i}" for i in (1, 2, 3)),
    ),
    expect(
        "A desk with two lamps side by side and a mug in front of them.",
        same("desk", "lamp 1", "lamp 2", "mug"),
        "lamp 1 on desk", "lamp 2 on desk", "mug on desk", "lamp 1 left_of lamp 2",
        "mug in_front_of lamp 1", "mug in_front_of lamp 2",
    ),
    expect(
        "Two boxes in a row with a ball in the first and a block in the last.",
        same("box 1", "box 2", "ball", "block"),
        "ball in box 1", "block in box 2", "box 1 left_of box 2",
    ),
    # Telling by placing, passive voice, fragments
    expect(
        "First put a plate on the table, then put a bowl on the plate, and finally place an egg inside the bowl.",
        same("plate", "table", "bowl", "egg"),
        "plate on table", "bowl on plate", "egg in bowl",
    ),
    expect("Move the mug to the left of the plate.", same("mug", "plate")),
    expect("Hang the hat on the tree.", same("hat", "tree")),
    expect("The mug should be on the plate.", same("mug", "plate")),
    expect(
        "A tray was placed on a table and two mugs were set on it.",
        same("tray", "table", "mug 1", "mug 2"),
        "tray on table", "mug 1 on tray", "mug 2 on tray",
    ),
    expect(
        "mug on plate on tray on table", same("mug", "plate", "tray", "table"),
        "mug on plate", "plate on tray", "tray on table",
    ),
    expect(
        "radio; mug right of radio; bowl left of radio",
        same("radio", "mug", "bowl"),
        "mug right_of radio", "bowl left_of radio",
    ),
    expect(
        "A book under a lamp on a table.",
        same("book", "lamp", "table"),
        "book on table", "lamp on book",
    ),
    expect(
        "Bowl on plate, spoon in bowl, napkin left of plate.",
        same("bowl", "plate", "spoon", "napkin"),
        "bowl on plate", "spoon in bowl", "napkin left_of plate",
    ),
    expect(
        "A plate, to the left of which is a fork and to the right of which is a knife.",
        same("plate", "fork", "knife"),
        "fork left_of plate", "knife right_of plate",
    ),
    expect(
        "A tower of blocks: red at the bottom, blue in the middle and green on top.",
        coloured("block", "red", "blue", "green"),
        "blue block on red block", "green block on blue block",
    ),
    expect("A plate underneath a bowl underneath a cup.", same("plate", "bowl", "cup"), "bowl on plate", "cup on bowl"),
    expect(
        "A table with two chairs on opposite sides.",
        same("table", "chair 1", "chair 2"),
        "chair 1 left_of table", "chair 2 right_of table",
    ),
    expect(
        "Mugs on a shelf, in two rows of two",
        same("mug 1", "mug 2", "mug 3", "mug 4", "shelf"),
        *(f"mug {i} on shelf" for i in (1, 2, 3, 4)), "mug 1 left_of mug 2", "mug 3 left_of mug 4",
        "mug 3 behind mug 1", "mug 4 behind mug 2",
    ),
    expect(
        "A basket, a jar and, in front of the jar, a mug",
        same("basket", "jar", "mug"),
        "mug in_front_of jar",
    ),
    expect("A mug at the edge of a table.", same("mug", "table"), "mug on table"),
    expect(
        "A 20 cm tall vase beside two 5cm blocks.",
        same("vase", "block 1", "block 2"),
        "vase next_to block 1", "vase next_to block 2",
    ),
    expect("A fork upside down on a plate.", same("fork", "plate"), "fork on plate"),
)  # fmt: skip

"""Prompts of the project's own words with the plan that a person reads in them, written by hand.

Each entry: the prompt, the objects as {name: catalogue noun}, and the relations as "child kind parent" with the names
of the objects. Objects without a support relation stand on the ground.
"""

from __future__ import annotations

from dataclasses import dataclass, field


@dataclass(frozen=True, kw_only=True)
class Expected:
    prompt: str
    objects: dict[str, str]
    relations: frozenset[str] = field(default_factory=frozenset)


def same(*names: str) -> dict[str, str]:
    """Objects whose names are their nouns, with a number or without."""
    return {name: name.rstrip("0123456789 ") for name in names}


def expect(prompt: str, objects: dict[str, str], *relations: str) -> Expected:
    return Expected(prompt=prompt, objects=objects, relations=frozenset(relations))


PROMPTS = (
    # Rooms
    expect(
        "A sunny bedroom with a bed, a bookcase, a nightstand and a puppy on the rug.",
        {"bed": "bed", "bookcase": "bookshelf", "nightstand": "bedside table", "puppy": "dog", "rug": "rug"},
        "puppy on rug",
    ),
    expect(
        "a playful cartoon room with a sofa, beside table, plant, and a tiny turtle on the sofa",
        {"sofa": "sofa", "bedside table": "bedside table", "plant": "plant", "tiny turtle": "turtle"},
        "tiny turtle on sofa",
    ),
    expect(
        "An elegant studio scene with a couch, a side table, a small sculpture, a fluffy rug.",
        {"couch": "sofa", "side table": "side table", "small sculpture": "sculpture", "rug": "rug"},
    ),
    expect(
        "a calm evening setup with a bed, bedside tables, a lamp and some books",
        same("bed", "bedside table 1", "bedside table 2", "lamp", "book 1", "book 2", "book 3"),
    ),
    expect(
        "A little stool beside a square table in a plain room.",
        {"little stool": "stool", "table": "table"},
        "little stool next_to table",
    ),
    # Stacks
    expect(
        "a baby turtle resting on top of a stack of books",
        {"baby turtle": "turtle", **same("book 1", "book 2", "book 3", "book 4")},
        "book 2 on book 1", "book 3 on book 2", "book 4 on book 3", "baby turtle on book 4",
    ),
    expect(
        "Close-up view, showing the whole objects. Three stacked bowls and two stacked plates.",
        same("bowl 1", "bowl 2", "bowl 3", "plate 1", "plate 2"),
        "bowl 2 on bowl 1", "bowl 3 on bowl 2", "plate 2 on plate 1",
    ),
    expect(
        "A tower of colourful wooden blocks standing upright, featuring green, red, and white pieces, "
        "balanced on the floor.",
        {"green wooden block": "block", "red wooden block": "block", "white wooden block": "block"},
        "red wooden block on green wooden block", "white wooden block on red wooden block",
    ),
    expect(
        "a plush dog with four different coloured caps stacked on its head",
        {"plush dog": "plush dog", "red cap": "cap", "blue cap": "cap", "yellow cap": "cap", "green cap": "cap"},
        "red cap on plush dog", "blue cap on red cap", "yellow cap on blue cap", "green cap on yellow cap",
    ),
    expect(
        "Two stacks of two plates on a table",
        same("plate 1", "plate 2", "plate 3", "plate 4", "table"),
        "plate 1 on table", "plate 2 on plate 1", "plate 3 on table", "plate 4 on plate 3",
    ),
    expect(
        "Three boxes stacked on top of each other next to a chair",
        same("box 1", "box 2", "box 3", "chair"),
        "box 2 on box 1", "box 3 on box 2", "box 1 next_to chair",
    ),
    # Desks and shelves
    expect(
        "a Wizard sitting behind a Writing Desk, looking at a Candle standing on the Writing Desk, "
        "with a Pile of three Dusty Books lying on the Writing Desk",
        {"wizard": "wizard", "writing desk": "desk", **same("candle", "book 1", "book 2", "book 3")},
        "wizard behind writing desk", "candle on writing desk", "book 1 on writing desk", "book 2 on book 1",
        "book 3 on book 2",
    ),
    expect(
        "An old metal radio with a tiny giraffe on top stands on two books, next to a glass jar containing three pens.",
        {"metal radio": "radio", "tiny giraffe": "giraffe", "glass jar": "jar",
         **same("book 1", "book 2", "pen 1", "pen 2", "pen 3")},
        "metal radio on book 1", "tiny giraffe on metal radio", "pen 1 in glass jar", "pen 2 in glass jar",
        "pen 3 in glass jar", "book 1 next_to glass jar",
    ),
    expect(
        "On the left side, there is a ceramic mug holding a ruler and two red pencils. On the right side, there is a "
        "stack of two books with blue covers. The objects stand on a pale surface, and the background is white, "
        "giving a calm and clean picture.",
        {"ceramic mug": "mug", "ruler": "ruler", "red pencil 1": "pencil", "red pencil 2": "pencil",
         "blue book 1": "book", "blue book 2": "book"},
        "ruler in ceramic mug", "red pencil 1 in ceramic mug", "red pencil 2 in ceramic mug",
        "blue book 2 on blue book 1", "ceramic mug left_of blue book 1",
    ),
    expect(
        "The items are a lamp and a mug. Everything is placed on a wooden desk.",
        {"lamp": "lamp", "mug": "mug", "wooden desk": "desk"},
        "lamp on wooden desk", "mug on wooden desk",
    ),
    expect(
        "A metal desk with a green bottle stands behind a wooden bench with a red hat on it, flanked by two crates on "
        "one side and a cart holding a potted small plant on the other side.",
        {"metal desk": "desk", "green bottle": "bottle", "wooden bench": "bench", "red hat": "hat", "crate 1": "crate",
         "crate 2": "crate", "cart": "cart", "small potted plant": "potted plant"},
        "metal desk behind wooden bench", "green bottle on metal desk", "red hat on wooden bench",
        "crate 1 left_of metal desk", "crate 2 left_of metal desk", "cart right_of metal desk",
        "small potted plant on cart",
    ),
    expect(
        "A red cap and a basket on one of the shelves of a bookcase",
        {"red cap": "cap", "basket": "basket", "bookcase": "bookshelf"},
        "red cap on bookcase", "basket on bookcase",
    ),
    expect(
        "A bookcase with a red cap on one of the shelves and a basket on top",
        {"bookcase": "bookshelf", "red cap": "cap", "basket": "basket"},
        "red cap on bookcase", "basket on bookcase",
    ),
    # Vessels
    expect(
        "In a bowl of fruit, there are three fruits.",
        {**same("apple", "orange", "banana"), "bowl": "fruit bowl"},
        "apple in bowl", "orange in bowl", "banana in bowl",
    ),
    expect(
        "a bird perched on a small basket of rainbow blocks",
        {"bird": "bird", "small basket": "basket",
         **{f"{c} block": "block" for c in ("red", "orange", "yellow", "green", "blue", "purple")}},
        "bird on small basket", "red block in small basket", "orange block in small basket",
        "yellow block in small basket", "green block in small basket", "blue block in small basket",
        "purple block in small basket",
    ),
    expect(
        "On a desk, there is a jar with a bouquet of flowers. Next to it, there is a plate of pancakes",
        {"desk": "desk", "jar": "jar", "bouquet of flowers": "bouquet", "plate": "plate",
         **same("pancake 1", "pancake 2", "pancake 3")},
        "jar on desk", "bouquet of flowers in jar", "plate on desk", "plate next_to jar", "pancake 1 on plate",
        "pancake 2 on plate", "pancake 3 on plate",
    ),
    expect(
        "A brown glass holds two red and yellow pencils, a white and black pen, and a green-handled spoon, while a "
        "gray soap dish next to it holds two bars of soap - one green and one pink.",
        {"brown glass": "glass", "red pencil": "pencil", "yellow pencil": "pencil", "white and black pen": "pen",
         "green spoon": "spoon", "gray soap dish": "soap dish", "green bar of soap": "soap",
         "pink bar of soap": "soap"},
        "red pencil in brown glass", "yellow pencil in brown glass", "white and black pen in brown glass",
        "green spoon in brown glass", "gray soap dish next_to brown glass", "green bar of soap in gray soap dish",
        "pink bar of soap in gray soap dish",
    ),
    expect(
        "A paddling pool filled with tiny red, white, and gold plastic balls contains a sailboat and two rubber ducks.",
        {"paddling pool": "inflatable pool", "sailboat": "toy sailboat", "rubber duck 1": "rubber duck",
         "rubber duck 2": "rubber duck",
         **{f"tiny {c} plastic ball {i}": "ball" for c in ("red", "white", "gold") for i in (1, 2, 3)}},
        "sailboat in paddling pool", "rubber duck 1 in paddling pool", "rubber duck 2 in paddling pool",
        *(f"tiny {c} plastic ball {i} in paddling pool" for c in ("red", "white", "gold") for i in (1, 2, 3)),
    ),
    expect(
        "A dozen eggs in a basket on a table beside a teapot",
        {**{f"egg {i}": "egg" for i in range(1, 13)}, **same("basket", "table", "teapot")},
        *(f"egg {i} in basket" for i in range(1, 13)), "basket on table", "teapot on table", "basket next_to teapot",
    ),
    expect(
        "A bowl containing an apple, two lemons and a pear, with a spoon beside it",
        {**same("apple", "lemon 1", "lemon 2", "pear", "spoon"), "bowl": "fruit bowl"},
        "apple in bowl", "lemon 1 in bowl", "lemon 2 in bowl", "pear in bowl", "spoon next_to bowl",
    ),
    # Lists inside lists
    expect(
        "A fruit bowl with a pear, a lemon and an apple, a stack of two books with a blue mug on top, and next to it a "
        "pen holder holding two pens and a ruler.",
        same("fruit bowl", "pear", "lemon", "apple", "book 1", "book 2", "blue mug", "pen holder", "pen 1", "pen 2",
             "ruler") | {"blue mug": "mug"},
        "pear in fruit bowl", "lemon in fruit bowl", "apple in fruit bowl", "book 2 on book 1", "blue mug on book 2",
        "pen holder next_to book 1", "pen 1 in pen holder", "pen 2 in pen holder", "ruler in pen holder",
    ),
    expect(
        "On a desk there is a bowl with an orange and a lemon, a mug and a lamp.",
        {**same("desk", "orange", "lemon", "mug", "lamp"), "bowl": "fruit bowl"},
        "bowl on desk", "orange in bowl", "lemon in bowl", "mug on desk", "lamp on desk",
    ),
    expect(
        "On a desk there is a basket with an apple, a pear, and a banana, and a teapot.",
        same("desk", "basket", "apple", "pear", "banana", "teapot"),
        "basket on desk", "apple in basket", "pear in basket", "banana in basket", "teapot on desk",
    ),
    expect(
        "A basket with an apple, a pear and a banana and an egg on a table",
        same("basket", "apple", "pear", "banana", "egg", "table"),
        "apple in basket", "pear in basket", "banana in basket", "basket on table", "egg on table",
    ),
    expect(
        "A crate with an apple and a pear and a lemon",
        same("crate", "apple", "pear", "lemon"),
        "apple in crate", "pear in crate", "lemon in crate",
    ),
    expect(
        "A green mug on a stack of two books, beside a fruit bowl holding a lemon, a pear and an orange, and a pen "
        "holder with a pen and a ruler.",
        {**same("book 1", "book 2", "fruit bowl", "lemon", "pear", "orange", "pen holder", "pen", "ruler"),
         "green mug": "mug"},
        "green mug on book 2", "book 2 on book 1", "book 1 next_to fruit bowl", "lemon in fruit bowl",
        "pear in fruit bowl", "orange in fruit bowl", "pen in pen holder", "ruler in pen holder",
    ),
    expect(
        "A bowl with an egg and a lamp on a desk, a chair behind the desk",
        same("bowl", "egg", "lamp", "desk", "chair"),
        "egg in bowl", "bowl on desk", "lamp on desk", "chair behind desk",
    ),
    expect(
        "A desk with a lamp and a mug, a book and a chair",
        same("desk", "lamp", "mug", "book", "chair"),
        "lamp on desk", "mug on desk", "book on desk", "chair next_to desk",
    ),
    expect(
        "A napkin with a fork and a knife on it",
        same("napkin", "fork", "knife"),
        "fork on napkin", "knife on napkin",
    ),
    # Reference
    expect(
        "A fruit bowl with a pear and two lemons stands on a table. Behind the bowl, there is a teapot.",
        same("fruit bowl", "pear", "lemon 1", "lemon 2", "table", "teapot"),
        "pear in fruit bowl", "lemon 1 in fruit bowl", "lemon 2 in fruit bowl", "fruit bowl on table",
        "teapot on table", "teapot behind fruit bowl",
    ),
    expect(
        "A loaf of bread and a pen holder on a desk. To the left of the loaf is a knife. The holder is blue.",
        {"loaf of bread": "bread", "blue pen holder": "pen holder", "desk": "desk", "knife": "knife"},
        "loaf of bread on desk", "blue pen holder on desk", "knife on desk", "knife left_of loaf of bread",
    ),
    expect("A coffee table next to the table", same("coffee table", "table"), "coffee table next_to table"),
    # Between
    expect(
        "A stack of two books with a blue mug on top stands between a fruit bowl with a pear and a peach and a pen "
        "holder with a pen.",
        {**same("book 1", "book 2", "fruit bowl", "pear", "peach", "pen holder", "pen"), "blue mug": "mug"},
        "book 2 on book 1", "blue mug on book 2", "pear in fruit bowl", "peach in fruit bowl", "pen in pen holder",
        "fruit bowl left_of book 1", "pen holder right_of book 1",
    ),
    expect(
        "A candle between a basket with two eggs and a teapot",
        same("candle", "basket", "egg 1", "egg 2", "teapot"),
        "egg 1 in basket", "egg 2 in basket", "basket left_of candle", "teapot right_of candle",
    ),
    # The support of a whole list
    expect(
        "A wooden crate of two lemons, a loaf of bread on a cutting board and a bottle on a table.",
        {"wooden crate": "crate", "loaf of bread": "bread", **same("lemon 1", "lemon 2", "cutting board", "bottle",
         "table")},
        "lemon 1 in wooden crate", "lemon 2 in wooden crate", "wooden crate on table", "cutting board on table",
        "loaf of bread on cutting board", "bottle on table",
    ),
    expect(
        "A loaf of bread on a cutting board and a bottle on a table.",
        {"loaf of bread": "bread", **same("cutting board", "bottle", "table")},
        "loaf of bread on cutting board", "bottle on table",
    ),
    # Sofas and toys
    expect(
        "A gray sofa decorated with stuffed animals, including a teddy bear, a brown rabbit, and two throw pillows, "
        "stands in a bright room with a blue floor cushion in front.",
        {"gray sofa": "sofa", "teddy bear": "teddy bear", "brown rabbit": "rabbit", "throw pillow 1": "pillow",
         "throw pillow 2": "pillow", "blue floor cushion": "floor cushion"},
        "teddy bear on gray sofa", "brown rabbit on gray sofa", "throw pillow 1 on gray sofa",
        "throw pillow 2 on gray sofa", "blue floor cushion in_front_of gray sofa",
    ),
    expect(
        "A teddy bear wearing a red hat sits between two pillows on a bed",
        {"teddy bear": "teddy bear", "red hat": "hat", **same("pillow 1", "pillow 2", "bed")},
        "red hat on teddy bear", "teddy bear on bed", "pillow 1 on bed", "pillow 2 on bed",
        "pillow 1 left_of teddy bear", "pillow 2 right_of teddy bear",
    ),
    expect(
        "two dogs, each wearing a hat",
        same("dog 1", "dog 2", "hat 1", "hat 2"),
        "hat 1 on dog 1", "hat 2 on dog 2",
    ),
    expect(
        "A chair hanging from a big tree, with a ball under it",
        {"chair": "chair", "big tree": "tree", "ball": "ball"},
        "chair hangs_from big tree", "ball next_to big tree",
    ),
    # Tables
    expect(
        "A round table with a bowl of two oranges, a white cup and a stack of three plates on it, "
        "surrounded by four chairs",
        {"table": "table", "bowl": "fruit bowl", "white cup": "cup",
         **same("orange 1", "orange 2", "plate 1", "plate 2", "plate 3", "chair 1", "chair 2", "chair 3", "chair 4")},
        "bowl on table", "orange 1 in bowl", "orange 2 in bowl", "white cup on table", "plate 1 on table",
        "plate 2 on plate 1", "plate 3 on plate 2", *(f"chair {i} around table" for i in (1, 2, 3, 4)),
    ),
    expect(
        "On the left side of the table there is a mug; on the right side there is a plate with two cookies.",
        same("table", "mug", "plate", "cookie 1", "cookie 2"),
        "mug on table", "plate on table", "cookie 1 on plate", "cookie 2 on plate", "mug left_of plate",
    ),
    expect(
        "Four plates on a table with an apple on each plate",
        same("plate 1", "plate 2", "plate 3", "plate 4", "table", "apple 1", "apple 2", "apple 3", "apple 4"),
        *(f"plate {i} on table" for i in (1, 2, 3, 4)), *(f"apple {i} on plate {i}" for i in (1, 2, 3, 4)),
    ),
    expect(
        "a cup holding two pens on a desk, next to a lamp",
        same("cup", "pen 1", "pen 2", "desk", "lamp"),
        "pen 1 in cup", "pen 2 in cup", "cup on desk", "lamp on desk", "cup next_to lamp",
    ),
    expect(
        "A mug to the left of a plate and to the right of a bowl",
        same("mug", "plate", "bowl"),
        "mug left_of plate", "mug right_of bowl",
    ),
    expect(
        "Place three mugs in a row on the shelf",
        same("mug 1", "mug 2", "mug 3", "shelf"),
        "mug 1 on shelf", "mug 2 on shelf", "mug 3 on shelf", "mug 1 left_of mug 2", "mug 2 left_of mug 3",
    ),
    expect(
        "There is a desk. On it is a mug. Beside it is a pair of scissors. A stool stands in front of the desk.",
        same("desk", "mug", "scissors", "stool"),
        "mug on desk", "scissors on desk", "scissors next_to mug", "stool in_front_of desk",
    ),
    expect(
        "a lamp on each side of the bed and a rug in front of it",
        same("lamp 1", "lamp 2", "bed", "rug"),
        "lamp 1 left_of bed", "lamp 2 right_of bed", "rug in_front_of bed",
    ),
    expect(
        "A soft and fluffy rug under a coffee table with a cup of tea and a pair of candles",
        same("rug", "coffee table", "cup", "candle 1", "candle 2"),
        "coffee table on rug", "cup on coffee table", "candle 1 on coffee table", "candle 2 on coffee table",
    ),
    expect(
        "There are three books on the bench: one red and two blue",
        {"red book": "book", "blue book 1": "book", "blue book 2": "book", "bench": "bench"},
        "red book on bench", "blue book 1 on bench", "blue book 2 on bench",
    ),
    expect(
        "To the left of the sofa is a chair, and to the right is a red apple which is on a tray.",
        {"sofa": "sofa", "chair": "chair", "red apple": "apple", "tray": "tray"},
        "chair left_of sofa", "tray right_of sofa", "red apple on tray",
    ),
    expect(
        "A tidy desk: a lamp, a crate full of oranges with a dog on top, and two glasses of milk",
        same("desk", "lamp", "crate", "dog", "glass 1", "glass 2", *(f"orange {i}" for i in range(1, 9))),
        "lamp on desk", "crate on desk", "dog on crate", "glass 1 on desk", "glass 2 on desk",
        *(f"orange {i} in crate" for i in range(1, 9)),
    ),
    expect(
        "A desk with a lamp on two books, without a computer",
        same("desk", "lamp", "book 1", "book 2"),
        "book 1 on desk", "book 2 on desk", "lamp on book 1",
    ),
    expect(
        "A photo of a bowl with six lemons on a cutting board. Behind it is a teapot.",
        {**same("cutting board", "teapot"), "bowl": "fruit bowl", **{f"lemon {i}": "lemon" for i in range(1, 7)}},
        *(f"lemon {i} in bowl" for i in range(1, 7)), "bowl on cutting board",
        "teapot behind cutting board",
    ),
)  # fmt: skip

"""HDF5 files changed at random: by bytes, and by datasets of other types, shapes and contents. The same seed, the same
files."""

import h5py
import numpy as np

#: What a random change puts in the place of numbers
REALS = (0.0, -0.0, 1e-300, 1e300, -1e308, np.nan, np.inf, -np.inf, 0.1, 1e60, 1e61)
WHOLES = (0, 1, -1, 2, 7, 2**31 - 1, 2**31, -(2**31), 2**62, 255)
TYPES = ("<i4", ">i8", "u1", "<u8", "<f4", ">f8", "<f2", "S5", "?", "c16")
SHAPES = ((), (0,), (1,), (3,), (7,), (1, 1), (3, 3), (3, 2), (2, 2, 2), (0, 3), (5, 1))


def datasets(file):
    found = []
    file.visititems(lambda name, item: found.append(name) if isinstance(item, h5py.Dataset) else None)
    return found


def changeable(file):
    """Datasets of numbers that an earlier change has not blown up."""
    return [name for name in datasets(file) if file[name].size < 1e6 and file[name].dtype.kind in "fiub"]


def put(file, name, data, **options):
    if name in file:
        del file[name]
    file.create_dataset(name, data=data, **options)


def changed_numbers(file, name, random):
    """One number, or a few, take values at the borders of what numbers can be."""
    data = file[name][...]
    if data.size == 0 or data.dtype.kind not in "fiu":
        return
    flat = data.reshape(-1).copy()
    for _ in range(random.choice((1, 1, 3))):
        at = random.randrange(flat.size)
        if data.dtype.kind == "f":
            flat[at] = random.choice(REALS) if random.random() < 0.7 else flat[random.randrange(flat.size)]
        elif random.random() < 0.5:
            flat[at] = flat[random.randrange(flat.size)]
        else:
            limits = np.iinfo(flat.dtype)
            flat[at] = min(max(random.choice(WHOLES), limits.min), limits.max)
    put(file, name, flat.reshape(data.shape))


def changed_form(file, name, random):
    """Another type, shape, rank or layout."""
    data = file[name][...]
    match random.randrange(8):
        case 0:
            with np.errstate(all="ignore"):
                put(file, name, data.astype(random.choice(TYPES)))
        case 1:
            put(file, name, np.resize(data, random.choice(SHAPES)))
        case 2:
            put(file, name, data[: random.randrange(len(data) + 1)] if data.ndim else data)
        case 3:
            put(file, name, np.concatenate([data, data]) if data.ndim else data)
        case 4 if data.ndim and data.size:
            put(file, name, data, compression="gzip", shuffle=random.random() < 0.5, fletcher32=random.random() < 0.5)
        case 5:
            put(file, name, data.T)
        case 6 if data.ndim:
            unwritten(file, name, data, random)
        case _:
            put(file, name, np.array([b"text", b"more"]))


def unwritten(file, name, data, random):
    """Far more rows than the file holds."""
    rows = random.choice((10**3, 10**6, 4 * 10**8, 10**9, 2**40, 2**62))
    del file[name]
    file.create_dataset(name, shape=(rows, *data.shape[1:]), dtype=data.dtype, chunks=(100, *data.shape[1:]))


def changed_tree(file, names, random):
    """Members are missing, elsewhere, links, or groups in the place of datasets."""
    name = random.choice(names)
    match random.randrange(7):
        case 0:
            del file[name]
        case 1:
            del file[name.split("/")[0]]
        case 2:
            del file[name]
            file[name] = h5py.SoftLink(random.choice(("/nowhere", "/" + name, "/", "/" + random.choice(names))))
        case 3:
            del file[name]
            file[name] = h5py.ExternalLink("no_such_file.h5", "/data")
        case 4:
            del file[name]
            file.create_group(name)
        case 5:
            other = random.choice(("x", "elements/B32", "nodes/more", "node_sets/a b", "node_sets/" + "n" * 600))
            if other not in file:
                file[other] = [1]
        case _:
            other = random.choice(names)
            if other != name:
                del file[name]
                file[name] = file[other]


def changed_bytes(path, random):
    """Some bytes of the file, more often near its beginning, where its structure is; or its end cut off."""
    content = bytearray(path.read_bytes())
    if random.random() < 0.15:
        path.write_bytes(content[: random.randrange(len(content))])
        return
    reach = random.choice((200, 3000, len(content)))
    for _ in range(random.choice((1, 1, 2, 8, 64))):
        at = random.randrange(min(reach, len(content)))
        content[at] = random.choice(
            (0, 255, 1, 127, 128, content[at] ^ (1 << random.randrange(8)), random.randrange(256))
        )
    path.write_bytes(content)


def mutate(path, random):
    """Change a file of which a copy is elsewhere, in one way or several."""
    if random.random() < 0.45:
        changed_bytes(path, random)
        return
    for _ in range(random.choice((1, 1, 1, 2, 4))):
        with h5py.File(path, "r+") as file:
            names = changeable(file)
            if not names:
                return
            kind = random.random()
            if kind < 0.45:
                changed_numbers(file, random.choice(names), random)
            elif kind < 0.8:
                changed_form(file, random.choice(names), random)
            else:
                changed_tree(file, names, random)

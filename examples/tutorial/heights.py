"""The bracket of the tutorial from several heights: largest force of the floor, and whether the aluminium yields."""

import carom

case = carom.load("bracket.toml")
case["time"]["end"] = 1.5e-4  # the first impact is over

print("height mm   largest force N   plastic work mJ")
for height in (500.0, 1000.0, 2000.0, 4000.0):
    case["initial"][0]["drop_height"] = height
    result = case.start().finish()
    force = result.history["floor.force_z"].max()
    print(f"{height:9.0f}   {force:15.0f}   {result.energy['plastic'][-1]:15.1f}   {result.verdict}")

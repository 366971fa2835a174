[
  (header)
  (storey)
  (roofs)
  (element)
  (comment)
] @fold

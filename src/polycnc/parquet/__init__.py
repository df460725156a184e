"""Tables as Parquet files, written column by column without any library.

writer    a file: row groups, column chunks, what stands at its end
pages     kernels: values without nulls, dictionaries, packed numbers
compiled  these kernels as machine code
thrift    records of the format's headers (Thrift's compact protocol)
schema    what fields are: to Parquet, and to Arrow, whose readers ask for more
"""
